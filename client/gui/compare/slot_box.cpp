#include "client/gui/compare/slot_box.h"

#include <QDropEvent>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QMenu>
#include <QMimeData>
#include <QPointer>
#include <QUrl>

#include "client/gui/app/on_pool.h"

namespace metamer::gui {

QString dragged_picture(const QMimeData& data) {
  for (const QUrl& url : data.urls()) {
    const QString file = url.toLocalFile();
    for (const char* extension : {".png", ".exr"})
      if (file.endsWith(QString::fromLatin1(extension), Qt::CaseInsensitive)) return file;
  }
  return {};
}

SlotBox::SlotBox(const QString& name, PicturesAtHand at_hand, QWidget* parent)
    : QWidget(parent),
      name_(name),
      at_hand_(std::move(at_hand)),
      button_(new QToolButton),
      title_(new QLabel(tr("drop a PNG or EXR here"))),
      layers_(new QComboBox) {
  setAcceptDrops(true);
  button_->setText(name);
  button_->setAccessibleName(tr("Choose picture %1").arg(name));
  button_->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(this);
  button_->setMenu(menu);
  connect(menu, &QMenu::aboutToShow, this, &SlotBox::fill_menu);
  title_->setTextFormat(Qt::PlainText);
  title_->setMinimumWidth(80);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(button_);
  row->addWidget(title_, 1);
  row->addWidget(layers_);
  layers_->setAccessibleName(tr("Part or layer of picture %1").arg(name));
  layers_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  layers_->hide();
  connect(layers_, &QComboBox::activated, this, &SlotBox::choose_layer);
}

void SlotBox::set_source(const PictureSource& source) {
  ++asked_;
  source_ = source;
  title_->setText(source.title());
  title_->setToolTip(source.file);
  list_layers();
  Q_EMIT chosen();
}

void SlotBox::set_at_hand(const PictureAtHand& one) {
  title_->setText(tr("%1 …").arg(one.title));
  const quint64 mine = ++asked_;
  one.ask([box = QPointer<SlotBox>(this), mine](const Picture& picture) {
    if (box && mine == box->asked_) box->set_source({{}, picture});
  });
}

/// Files that hold several pictures ask which is meant.
void SlotBox::list_layers() {
  layers_->hide();
  if (source_->file.isEmpty()) return;
  on_pool(
      this, [file = source_->file] { return client::picture_layers(file.toStdString()); },
      [this, mine = asked_](const std::vector<client::PictureLayer>& layers) {
        if (mine != asked_ || layers.empty()) return;
        choices_ = layers;
        layers_->clear();
        for (const client::PictureLayer& one : choices_) {
          layers_->addItem(QString::fromStdString(one.name));
          const bool chosen =
              one.choice.part == source_->choice.part && one.choice.layer == source_->choice.layer;
          if (chosen) layers_->setCurrentIndex(layers_->count() - 1);
        }
        if (!source_->choice.layer) layers_->setCurrentIndex(-1);
        layers_->show();
      });
}

void SlotBox::choose_layer(int i) {
  source_->choice = choices_[static_cast<std::size_t>(i)].choice;
  Q_EMIT chosen();
}

void SlotBox::tell(const QString& what) {
  if (!source_) return;
  title_->setText(what.isEmpty() ? source_->title()
                                 : QStringLiteral("%1 · %2").arg(source_->title(), what));
}

void SlotBox::fill_menu() {
  QMenu& menu = *button_->menu();
  menu.clear();
  menu.addAction(tr("&File…"), this, &SlotBox::choose_file);
  const QList<PictureAtHand> pictures = at_hand_();
  if (!pictures.isEmpty()) menu.addSeparator();
  for (const PictureAtHand& one : pictures)
    menu.addAction(one.title, this, [this, one] { set_at_hand(one); });
}

void SlotBox::choose_file() {
  const QString file = QFileDialog::getOpenFileName(this, tr("Picture %1").arg(name_), {},
                                                    tr("Pictures (*.png *.exr)"));
  if (!file.isEmpty()) set_source({file});
}

void SlotBox::dragEnterEvent(QDragEnterEvent* event) {
  if (!dragged_picture(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void SlotBox::dropEvent(QDropEvent* event) {
  set_source({dragged_picture(*event->mimeData())});
  event->acceptProposedAction();
}

}  // namespace metamer::gui
