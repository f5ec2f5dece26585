#include "client/gui/files/lost_texts.h"

#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <QStandardPaths>

#include "client/gui/app/main_window.h"
#include "client/gui/app/on_pool.h"
#include "client/gui/files/unsaved_texts.h"

namespace metamer::gui {
namespace {

/// As if it had been typed into its file as that is now.
void open_lost(MainWindow& window, const LostText& lost) {
  TextFile* file = nullptr;
  if (QFileInfo(lost.path).isReadable()) {
    if (lost.scene) window.open(lost.path);
    file = lost.scene ? window.file() : window.open_text(lost.path);
  }
  if (file == nullptr || file->path() != lost.path) {
    auto* document = new Document(&window);
    document->start_with({});
    window.add_scene(document);
    file = document;
  }
  window.show_text(file)->change_text(lost.text);
}

void ask_for_lost(MainWindow& window, const std::vector<LostText>& texts) {
  QStringList names;
  for (const LostText& lost : texts)
    names << (lost.path.isEmpty() ? QObject::tr("untitled") : QFileInfo(lost.path).fileName());
  auto* box = new QMessageBox(QMessageBox::Question, QObject::tr("Texts that were not saved"),
                              QObject::tr("Metamer ended before these were saved: %1.")
                                  .arg(names.join(QStringLiteral(", "))),
                              QMessageBox::NoButton, &window);
  box->setAttribute(Qt::WA_DeleteOnClose);
  const QPushButton* open = box->addButton(QObject::tr("&Open them"), QMessageBox::AcceptRole);
  const QPushButton* forget =
      box->addButton(QObject::tr("&Forget them"), QMessageBox::DestructiveRole);
  box->addButton(QObject::tr("Ask &later"), QMessageBox::RejectRole);
  QObject::connect(box, &QMessageBox::finished, &window, [&window, box, open, forget, texts] {
    if (box->clickedButton() == open)
      for (const LostText& lost : texts) open_lost(window, lost);
    // Kept anew before the old ones go.
    if (auto* unsaved = window.findChild<UnsavedTexts*>()) unsaved->keep();
    if (box->clickedButton() == open || box->clickedButton() == forget) UnsavedTexts::forget(texts);
  });
  box->open();
}

}  // namespace

QString unsaved_folder() {
  return QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) +
         QStringLiteral("/unsaved");
}

void offer_lost_texts(MainWindow& window, const QString& root) {
  on_pool(
      &window, [root] { return UnsavedTexts::lost(root); },
      [&window](const std::vector<LostText>& texts) {
        if (!texts.empty()) ask_for_lost(window, texts);
      });
}

}  // namespace metamer::gui
