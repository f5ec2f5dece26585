#include "client/gui/looks/look_command.h"

#include <utility>

namespace metamer::gui {

LookCommand::LookCommand(Document& document, client::Look look, const QString& text, int id)
    : QUndoCommand(text),
      document_(document),
      before_(document.look()),
      after_(std::move(look)),
      camera_(document.camera()),
      id_(id) {}

void LookCommand::undo() {
  if (after_.camera) document_.set_camera(camera_);
  document_.set_look(before_);
}

void LookCommand::redo() {
  if (after_.camera) document_.set_camera(std::nullopt);
  document_.set_look(after_);
}

bool LookCommand::mergeWith(const QUndoCommand* newer) {
  if (newer->id() != id_) return false;
  after_ = static_cast<const LookCommand*>(newer)->after_;
  return true;
}

}  // namespace metamer::gui
