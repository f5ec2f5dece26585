#include "client/gui/picture/picture_bar.h"

#include <cmath>

namespace metamer::gui {
namespace {

constexpr double most_stops = 20;
constexpr double third = 1.0 / 3;  // of a stop: a key

}  // namespace

PictureBar::PictureBar(MainWindow& window)
    : QToolBar(tr("Picture"), &window), window_(window), stops_(new QDoubleSpinBox) {
  setObjectName(QStringLiteral("picture"));
  setMovable(false);
  stops_->setRange(-most_stops, most_stops);
  stops_->setSingleStep(third);
  stops_->setDecimals(2);
  stops_->setPrefix(tr("EV "));
  stops_->setAccessibleName(tr("Exposure"));
  stops_->setToolTip(tr("Exposure in stops: E brighter, Shift+E darker"));
  addWidget(stops_);
  Actions& actions = window.actions();
  QAction* gamut = actions[QStringLiteral("view.gamut")];
  QAction* numbers = actions[QStringLiteral("view.numbers")];
  gamut->setIconText(tr("Gamut"));
  gamut->setToolTip(tr("Mark what the output can't show, and count it (G)"));
  numbers->setIconText(tr("Numbers"));
  numbers->setToolTip(tr("Numbers in pixels, from 32× on (N)"));
  addAction(gamut);
  addAction(numbers);
  connect(stops_, &QDoubleSpinBox::valueChanged, this, [this](double stops) {
    viewing_.stops = stops;
    show_everywhere();
  });
  // Thirds are rounded to hundredths: three of them are a stop.
  const auto step = [this](int by) {
    set_stops((std::round(stops_->value() / third) + by) * third);
  };
  actions.bind(QStringLiteral("view.brighter"), [step] { step(1); });
  actions.bind(QStringLiteral("view.darker"), [step] { step(-1); });
  numbers->setChecked(numbers_);
  actions.bind_toggle(QStringLiteral("view.gamut"), [this](bool marked) {
    viewing_.gamut = marked;
    show_everywhere();
  });
  actions.bind_toggle(QStringLiteral("view.numbers"), [this](bool shown) {
    numbers_ = shown;
    show_everywhere();
  });
  connect(&window.pictures(), &QTabWidget::currentChanged, this, [this] {
    if (PicturePage* page = window_.picture_page()) show_on(*page);
  });
}

void PictureBar::set_stops(double stops) { stops_->setValue(stops); }

void PictureBar::set_display(const QColorSpace& display) {
  viewing_.display = display;
  show_everywhere();
}

void PictureBar::show_everywhere() {
  for (int i = 0; i < window_.pictures().count(); ++i)
    if (auto* page = qobject_cast<PicturePage*>(window_.pictures().widget(i))) show_on(*page);
}

void PictureBar::show_on(PicturePage& page) {
  if (page.canvas().viewing() != viewing_) page.canvas().set_viewing(viewing_);
  page.canvas().set_numbers(numbers_);
}

}  // namespace metamer::gui
