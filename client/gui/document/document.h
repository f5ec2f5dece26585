#pragma once

#include <QTimer>
#include <QUndoStack>
#include <memory>
#include <optional>
#include <vector>

#include "client/gui/document/text_file.h"
#include "client/tools/scene/checked_scene.h"
#include "client/tools/scene/look.h"

namespace metamer::gui {

/// A scene that is open: its text as it is typed, what a check found of it, and the changes that
/// are made to it by hand without touching the text (its look). Pictures, jobs and views hang off
/// it.
class Document : public TextFile {
  Q_OBJECT
 public:
  explicit Document(QObject* parent = nullptr);
  ~Document() override;

  /// The text is checked when nothing was typed for `quiet`; files of a scene that has none itself
  /// are named from the current folder.
  void check_now();
  /// Whether the newest check is of the text as it is now.
  bool settled() const { return !timer_.isActive() && !checking_ && !again_; }
  static constexpr std::chrono::milliseconds quiet{150};

  /// The newest check; null before the first. Problems are at their places in the text.
  std::shared_ptr<const client::CheckedScene> checked() const { return checked_; }
  /// The newest that was sound; null: none was.
  std::shared_ptr<const client::CheckedScene> sound() const { return sound_; }

  /// All that is wrong, at its place: what the newest check found, else what a server found since.
  const std::vector<Problem>& problems() const { return problems_; }
  /// Why a server did not take the scene as it is now; empty: it took it.
  void set_server_problems(const std::vector<Problem>& problems);

  const client::Look& look() const { return look_; }
  void set_look(client::Look look);
  /// By hand, whatever the look says; nothing: that of the look or the scene.
  const std::optional<v1::Camera>& camera() const { return camera_; }
  void set_camera(const std::optional<v1::Camera>& camera);
  /// That of effective(), without making the scene.
  v1::Camera seen_camera() const;
  /// The sound scene with look and camera. Error: the look names what the scene has not.
  Result<v1::Scene> effective() const;
  /// Of the look: the text has its own, the editor's.
  QUndoStack& undo() { return undo_; }

 Q_SIGNALS:
  void checked_changed();
  void problems_changed();
  void look_changed();
  void camera_changed();  ///< By hand.

 private:
  void start_check();

  void set_problems(std::vector<Problem> problems);

  bool again_ = false, checking_ = false;
  QTimer timer_;
  std::shared_ptr<client::DigestCache> digests_;
  std::shared_ptr<const client::CheckedScene> checked_, sound_;
  std::vector<Problem> problems_;
  client::Look look_;
  std::optional<v1::Camera> camera_;
  QUndoStack undo_;
};

}  // namespace metamer::gui
