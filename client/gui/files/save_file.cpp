#include "client/gui/files/save_file.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <optional>

#include "client/gui/app/add_app.h"
#include "client/gui/app/on_pool.h"
#include "client/gui/document/document.h"
#include "client/tools/scene/copy_files.h"

namespace metamer::gui {
namespace {

/// The demo stays as it is delivered.
bool is_demo(const TextFile& file) {
  return !file.path().isEmpty() && QFileInfo(file.path()).canonicalFilePath() == find_booth();
}

/// The files that a scene names; of an unsound one, those of when it was sound last.
std::vector<std::string> names_in_scene(const TextFile& file) {
  std::vector<std::string> names;
  const auto* document = qobject_cast<const Document*>(&file);
  if (document != nullptr && document->sound())
    for (const Asset& asset : document->sound()->assets()) names.push_back(asset.name);
  return names;
}

void copy_along(QWidget* parent, Document* document, std::vector<std::string> names,
                const QString& from, const QString& to) {
  on_pool(
      document,
      [names = std::move(names), from = from.toStdString(), to = to.toStdString()] {
        return client::copy_files(names, from, to);
      },
      [parent, document](const Result<client::CopiedFiles>& done) {
        document->check_now();
        if (!done)
          QMessageBox::warning(parent, QObject::tr("Save as"),
                               QString::fromStdString(done.error().message));
        else if (!done->kept.empty())
          QMessageBox::warning(
              parent, QObject::tr("Save as"),
              QObject::tr("%1 is there already with another content, and was left as it is.")
                  .arg(QString::fromStdString(done->kept.front())));
      });
}

/// Whether the files are to come along; nothing: the scene is not to be saved after all.
std::optional<bool> ask_along(QWidget* parent, const std::vector<std::string>& names) {
  const auto answer = QMessageBox::question(
      parent, QObject::tr("Save as"),
      QObject::tr("The scene names %1 of its folder. Copy to the new one?")
          .arg(names.size() == 1 ? QObject::tr("a file, %1,").arg(QString::fromStdString(names[0]))
                                 : QObject::tr("%1 files").arg(names.size())),
      QMessageBox::Yes | QMessageBox::No | QMessageBox::Cancel, QMessageBox::Yes);
  if (answer == QMessageBox::Cancel) return std::nullopt;
  return answer == QMessageBox::Yes;
}

QString ask_path(QWidget* parent, const TextFile& file) {
  const bool scene = qobject_cast<const Document*>(&file) != nullptr, demo = is_demo(file);
  QString path = QFileDialog::getSaveFileName(
      parent,
      demo ? QObject::tr("A folder for the demo booth and its files") : QObject::tr("Save as"),
      demo ? QDir::home().filePath(file.title()) : file.path(),
      scene ? QObject::tr("Scenes (*.txtpb);;All files (*)") : QString());
  if (scene && !path.isEmpty() && QFileInfo(path).suffix().isEmpty())
    path += QStringLiteral(".txtpb");
  return path;
}

}  // namespace

bool save_to(QWidget* parent, TextFile& file, const QString& path) {
  const QString from = QFileInfo(file.path()).absolutePath(), to = QFileInfo(path).absolutePath();
  const std::vector<std::string> names = names_in_scene(file);
  bool along = !file.path().isEmpty() && from != to && !names.empty();
  if (along && !is_demo(file)) {
    const std::optional<bool> answer = ask_along(parent, names);
    if (!answer) return false;
    along = *answer;
  }
  if (const Result<void> saved = file.save(path); !saved) {
    QMessageBox::warning(
        parent, QObject::tr("Save"),
        QObject::tr("%1: %2").arg(path, QString::fromStdString(saved.error().message)));
    return false;
  }
  if (along) copy_along(parent, qobject_cast<Document*>(&file), names, from, to);
  return true;
}

bool save_file(QWidget* parent, TextFile& file, bool elsewhere) {
  const bool ask = elsewhere || file.path().isEmpty() || is_demo(file);
  const QString path = ask ? ask_path(parent, file) : file.path();
  return !path.isEmpty() && save_to(parent, file, path);
}

}  // namespace metamer::gui
