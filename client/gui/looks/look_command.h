#pragma once

#include <QUndoCommand>
#include <optional>

#include "client/gui/document/document.h"

namespace metamer::gui {

/// Another look for a document, which can be undone.
class LookCommand : public QUndoCommand {
 public:
  /// Commands of one `id`, one after the other, are undone as one: what is dragged. Below 0: each
  /// is by itself.
  LookCommand(Document& document, client::Look look, const QString& text, int id = -1);

  void undo() override;
  void redo() override;
  int id() const override { return id_; }
  bool mergeWith(const QUndoCommand* newer) override;

 private:
  Document& document_;
  client::Look before_, after_;
  /// What was set by hand, where the look has a camera of its own, which takes its place.
  std::optional<v1::Camera> camera_;
  int id_;
};

}  // namespace metamer::gui
