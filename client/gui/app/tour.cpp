#include "client/gui/app/tour.h"

#include <QApplication>
#include <QDir>
#include <cstdio>
#include <utility>

#include "client/gui/app/main_window.h"

namespace metamer::gui {
namespace {

constexpr int beat = 5;  // ms

void choose(MainWindow& window, const QString& id) {
  auto* dock = window.findChild<QDockWidget*>(id);
  if (dock == nullptr) return window.actions()[id]->trigger();
  dock->show();
  dock->raise();
}

}  // namespace

const std::vector<TourStep>& tour_steps() {
  static const std::vector<TourStep> steps = {
      {"live", {}, 6000},
      {"inspector", {}, 2000, true},
      {"look", {"light.look.2"}, 4000},
      {"orbit", {"light.look.none", "view.orbit.left", "view.dolly.in"}, 3000},
      {"check", {"view.home", "render.check"}, 4000},
      {"settings", {"render.settings"}},
      {"render", {"render.render"}, 12000},
      {"exposed", {"view.brighter", "view.brighter", "view.brighter", "view.gamut"}, 2000},
      {"methods",
       {"view.gamut", "view.darker", "view.darker", "view.darker", "render.explain"},
       5000},
      {"spectra", {"spectra.manager"}, 2000},
      {"metamer", {"spectra.metamer"}, 3000},
      {"compare", {"compare.pictures"}, 2000},
      {"sheet", {"compare.sheet"}, 8000},
      {"models", {"help.models"}, 2000},
      {"keys", {"help.keys"}},
      {"palette", {"help.palette"}},
      {"server", {"help.server"}},
      {"about", {"help.about"}},
      {"jobs", {"jobs"}, 2000},
      {"log", {"log"}},
  };
  return steps;
}

void take_step(MainWindow& window, const TourStep& step) {
  for (const char* id : step.ids) choose(window, QString::fromUtf8(id));
  if (!step.point || window.live() == nullptr) return;
  Canvas& canvas = window.live()->canvas();
  Q_EMIT canvas.hovered(QPoint(canvas.image().width() / 2, canvas.image().height() * 2 / 5));
}

QWidget& front_window(MainWindow& window) {
  for (QWidget* top : QApplication::topLevelWidgets())
    if (top != &window && top->isVisible() &&
        (top->windowType() == Qt::Window || top->windowType() == Qt::Dialog))
      return *top;
  return window;
}

Tour::Tour(MainWindow& window, QString folder)
    : QObject(&window), window_(window), folder_(std::move(folder)) {
  QDir().mkpath(folder_);
  beat_.setTimerType(Qt::PreciseTimer);
  beat_.setInterval(beat);
  connect(&beat_, &QTimer::timeout, this,
          [this] { longest_ = std::max(longest_, between_.restart() - beat); });
  between_.start();
  beat_.start();
}

void Tour::start() { go_on(); }

void Tour::go_on() {
  if (step_ == tour_steps().size()) return QApplication::exit();
  const TourStep& step = tour_steps()[step_];
  QTimer::singleShot(step.wait, this, &Tour::grab);
  // A modal dialog runs a loop of its own: the timer goes on in it.
  take_step(window_, step);
}

void Tour::grab() {
  std::printf("%-12s the window's thread stood still for %lld ms at most\n",
              tour_steps()[step_].name, static_cast<long long>(std::exchange(longest_, 0)));
  QWidget& shown = front_window(window_);
  shown.grab().save(folder_ + QLatin1Char('/') + QString::fromUtf8(tour_steps()[step_++].name) +
                    QStringLiteral(".png"));
  if (&shown != &window_) shown.close();
  between_.restart();
  QTimer::singleShot(0, this, &Tour::go_on);
}

}  // namespace metamer::gui
