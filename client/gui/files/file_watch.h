#pragma once

#include <QPointer>

#include "client/gui/app/message_bar.h"
#include "client/gui/files/disk_watch.h"

namespace metamer::gui {

class SceneEditor;
class TextFile;

/// Looks after what others do to a text's file: a bar above the text asks whether to take it. Files
/// that a scene names cannot be kept as they were, as each check reads them: where one of them
/// changes, comes or goes, the scene is checked anew. Goes with the editor.
class FileWatch : public QObject {
  Q_OBJECT
 public:
  FileWatch(TextFile* file, SceneEditor* editor);

  MessageBar* bar() const { return bar_; }  ///< Null: nothing is asked.

 private:
  void follow();
  void look(const QStringList& changed);
  void read();
  void take(const std::optional<QString>& found);
  void ask(const QString& found);

  TextFile& file_;
  SceneEditor& editor_;
  DiskWatch watch_;
  QPointer<MessageBar> bar_;
  QString found_;  ///< What the bar asks about.
};

}  // namespace metamer::gui
