#pragma once

#include <QObject>
#include <QString>
#include <optional>

#include "common/problem.h"

namespace metamer::gui {

/// A file's text in UTF-8, of at most max_scene_text bytes. Error: what the system says, or that it
/// is another thing. From any thread.
Result<QString> read_text(const QString& path);

/// A text that is open in a tab: a scene's, or that of a file which a scene names.
class TextFile : public QObject {
  Q_OBJECT
 public:
  explicit TextFile(QObject* parent = nullptr) : QObject(parent) {}

  /// Of a file. Errors: those of read_text.
  Result<void> load(const QString& path);
  /// A text that has no file yet, and of which there is nothing to save.
  void start_with(const QString& text);
  /// Writes the text as a whole, or not at all.
  Result<void> save(const QString& path);

  const QString& path() const { return path_; }  ///< Empty: it was never saved.
  QString title() const;
  const QString& text() const { return text_; }
  bool modified() const { return modified_; }  ///< It differs from on_disk().
  /// What its file has, as it was loaded, saved or found since; nothing: the file has gone.
  const std::optional<QString>& on_disk() const { return on_disk_; }
  void set_on_disk(std::optional<QString> text);

  /// As it was typed.
  void set_text(const QString& text);

 Q_SIGNALS:
  /// The path, or whether there is something to save.
  void title_changed();
  void typed();   ///< The text, by set_text.
  void loaded();  ///< The text, by load.
  void saved();

 private:
  QString path_, text_;
  std::optional<QString> on_disk_ = QString();
  bool modified_ = false;
};

}  // namespace metamer::gui
