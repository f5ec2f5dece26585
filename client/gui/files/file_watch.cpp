#include "client/gui/files/file_watch.h"

#include <QDir>
#include <QFileInfo>
#include <optional>

#include "client/gui/app/on_pool.h"
#include "client/gui/document/document.h"
#include "client/gui/editor/scene_editor.h"

namespace metamer::gui {
namespace {

/// The files that a scene names; also those that are not there, as they may come.
QStringList files_named_by(const Document& document) {
  QStringList paths;
  for (const auto& checked : {document.checked(), document.sound()})
    if (checked)
      for (const Asset& asset : checked->assets())
        paths << QString::fromStdString(asset.path.string());
  const QDir folder = QFileInfo(document.path()).absoluteDir();
  for (const Problem& one : document.problems())
    if (!one.was.empty() && one.field.ends_with("file"))
      paths << folder.absoluteFilePath(QString::fromStdString(one.was));
  return paths;
}

}  // namespace

FileWatch::FileWatch(TextFile* file, SceneEditor* editor)
    : QObject(editor), file_(*file), editor_(*editor) {
  connect(&watch_, &DiskWatch::changed, this, &FileWatch::look);
  connect(file, &TextFile::loaded, this, &FileWatch::follow);
  connect(file, &TextFile::saved, this, &FileWatch::follow);
  if (const auto* document = qobject_cast<const Document*>(file))
    connect(document, &Document::checked_changed, this, &FileWatch::follow);
  follow();
}

void FileWatch::follow() {
  if (file_.path().isEmpty()) return;
  QStringList paths{QFileInfo(file_.path()).absoluteFilePath()};
  if (const auto* document = qobject_cast<const Document*>(&file_))
    paths << files_named_by(*document);
  paths.removeDuplicates();
  watch_.set_files(paths);
}

void FileWatch::look(const QStringList& changed) {
  const QString own = QFileInfo(file_.path()).absoluteFilePath();
  if (changed.contains(own)) read();
  auto* document = qobject_cast<Document*>(&file_);
  if (document != nullptr && changed != QStringList(own)) document->check_now();
}

void FileWatch::read() {
  on_pool(
      this,
      [path = file_.path()]() -> std::optional<QString> {
        Result<QString> text = read_text(path);
        return text ? std::optional(*std::move(text)) : std::nullopt;
      },
      [this](const std::optional<QString>& found) { take(found); });
}

/// Our own saving changes the file, too, and to what we know.
void FileWatch::take(const std::optional<QString>& found) {
  if (found && found != file_.on_disk() && *found != file_.text()) return ask(*found);
  if (found != file_.on_disk()) file_.set_on_disk(found);
  delete bar_;
}

void FileWatch::ask(const QString& found) {
  found_ = found;
  if (bar_) return;
  bar_ = new MessageBar(tr("%1 was changed on disk.").arg(file_.title()));
  bar_->add_answer(tr("Re&load"), [this] {
    editor_.change_text(found_);
    file_.set_on_disk(found_);
    editor_.setFocus();
  });
  bar_->add_answer(tr("&Keep"), [this] {
    file_.set_on_disk(found_);
    editor_.setFocus();
  });
  editor_.add_bar(bar_);
}

}  // namespace metamer::gui
