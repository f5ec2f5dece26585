#include "client/gui/problems/locate_file.h"

#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <utility>

#include "client/gui/app/on_pool.h"

namespace metamer::gui {
namespace {

using NameTaker = std::function<void(const QString&)>;

void copy_into(QWidget* parent, const QString& from, const QDir& folder, NameTaker done) {
  const QString name = QFileInfo(from).fileName();
  on_pool(
      parent,
      [from, to = folder.filePath(name)] {
        QFile file(from);
        return file.copy(to) ? QString() : file.errorString();
      },
      [parent, from, name, done = std::move(done)](const QString& error) {
        if (error.isEmpty()) return done(name);
        QMessageBox::warning(parent, QObject::tr("Locate"),
                             QObject::tr("%1 can't be copied: %2").arg(from, error));
      });
}

void offer_copy(QWidget* parent, const QString& from, const QDir& folder, NameTaker done) {
  auto* question =
      new QMessageBox(QMessageBox::Question, QObject::tr("Locate"),
                      QObject::tr("A scene names files of its own folder alone. Copy %1 there?")
                          .arg(QFileInfo(from).fileName()),
                      QMessageBox::Yes | QMessageBox::Cancel, parent);
  question->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(question, &QMessageBox::finished, parent,
                   [parent, from, folder, done = std::move(done)](int answer) {
                     if (answer == QMessageBox::Yes) copy_into(parent, from, folder, done);
                   });
  question->open();
}

}  // namespace

void locate_file(QWidget* parent, const QString& folder, const QString& was, NameTaker done) {
  auto* dialog = new QFileDialog(parent, QObject::tr("Where is %1?").arg(was), folder);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  QObject::connect(dialog, &QFileDialog::fileSelected, parent,
                   [parent, folder, done = std::move(done)](const QString& file) {
                     const QDir base(QFileInfo(folder).canonicalFilePath());
                     const QString name =
                         base.relativeFilePath(QFileInfo(file).canonicalFilePath());
                     if (!name.startsWith(QStringLiteral("../"))) return done(name);
                     offer_copy(parent, file, base, done);
                   });
  dialog->open();
}

}  // namespace metamer::gui
