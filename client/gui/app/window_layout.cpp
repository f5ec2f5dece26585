// The window's docks and panes: where they are, how wide, and as they were left last.
#include <QMenuBar>
#include <QSettings>
#include <QTimer>
#include <algorithm>
#include <utility>

#include "client/gui/app/main_window.h"

namespace metamer::gui {
namespace {

constexpr int layout_version = 2;  // of the docks: another one makes what was kept void

}  // namespace

QDockWidget* MainWindow::add_dock(const QString& id, const QString& title, QWidget* content,
                                  Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName(id);
  // A dock that floats can't be put back on Wayland in Qt 6.4 (QTBUG-87332).
  dock->setFeatures(QDockWidget::DockWidgetClosable | QDockWidget::DockWidgetMovable);
  dock->setWidget(content);
  dock->setProperty("home", area);
  put_dock(dock, area);
  docks_ << dock;
  dock->toggleViewAction()->setShortcut(QKeySequence(QStringLiteral("Alt+%1").arg(docks_.size())));
  for (QAction* menu : menuBar()->actions())
    if (menu->text() == QStringLiteral("&Window"))
      menu->menu()->addAction(dock->toggleViewAction());
  return dock;
}

/// In the tabs of those that are in that area.
void MainWindow::put_dock(QDockWidget* dock, Qt::DockWidgetArea area) {
  addDockWidget(area, dock);
  for (QDockWidget* other : docks_)
    if (other != dock && dockWidgetArea(other) == area) return tabifyDockWidget(other, dock);
}

/// One that was moved by hand stays.
void MainWindow::put_side_docks() {
  const auto from = narrow_ ? Qt::RightDockWidgetArea : Qt::BottomDockWidgetArea;
  for (QDockWidget* dock : docks_)
    if (dock->property("home").toInt() == Qt::RightDockWidgetArea && dockWidgetArea(dock) == from)
      put_dock(dock, narrow_ ? Qt::BottomDockWidgetArea : Qt::RightDockWidgetArea);
  size_panes();
}

void MainWindow::size_panes() {
  constexpr int editor_width = 480, side_width = 300, below_height = 110, tall_height = 260;
  for (QDockWidget* dock : docks_) {
    if (!dock->isVisible()) continue;
    if (dockWidgetArea(dock) == Qt::RightDockWidgetArea)
      resizeDocks({dock}, {side_width}, Qt::Horizontal);
    if (dockWidgetArea(dock) == Qt::BottomDockWidgetArea)
      resizeDocks({dock}, {narrow_ ? tall_height : below_height}, Qt::Vertical);
  }
  panes_->setSizes({editor_width, std::max(1, panes_->width() - editor_width)});
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  if (std::exchange(narrow_, width() < narrow) != narrow_)
    QTimer::singleShot(0, this, &MainWindow::put_side_docks);
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  if (!std::exchange(restored_, true)) size_panes();
}

void MainWindow::reset_layout() {
  restoreState(first_layout_, layout_version);
  put_side_docks();
}

void MainWindow::restore_layout() {
  const QSettings settings;
  restoreGeometry(settings.value(QStringLiteral("geometry")).toByteArray());
  restored_ = restoreState(settings.value(QStringLiteral("state")).toByteArray(), layout_version) &&
              panes_->restoreState(settings.value(QStringLiteral("panes")).toByteArray());
  narrow_ = settings.value(QStringLiteral("narrow")).toBool();
}

void MainWindow::keep_first_layout() { first_layout_ = saveState(layout_version); }

void MainWindow::keep_layout() const {
  QSettings settings;
  settings.setValue(QStringLiteral("geometry"), saveGeometry());
  settings.setValue(QStringLiteral("state"), saveState(layout_version));
  settings.setValue(QStringLiteral("panes"), panes_->saveState());
  settings.setValue(QStringLiteral("narrow"), narrow_);
}

}  // namespace metamer::gui
