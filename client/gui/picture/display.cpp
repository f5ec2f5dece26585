#include "client/gui/picture/display.h"

#include <QDBusConnection>
#include <QFileDialog>
#include <QScreen>
#include <QSettings>
#include <QStatusBar>
#include <QTimer>
#include <QWindow>

#include "client/gui/app/on_pool.h"
#include "client/gui/picture/display_profile.h"

namespace metamer::gui {
namespace {

const QString display_setting = QStringLiteral("display_profile");

QString display_file() { return QSettings().value(display_setting).toString(); }

}  // namespace

Display::Display(MainWindow& window, PictureBar& bar)
    : QObject(&window), window_(window), bar_(bar), label_(new QLabel) {
  window.statusBar()->addPermanentWidget(label_);
  window.actions().bind(QStringLiteral("view.display.system"), [this] { choose({}); });
  window.actions().bind(QStringLiteral("view.display.file"), [this] { ask(); });
  // A window knows its screen once it is shown.
  QTimer::singleShot(0, this, [this] {
    if (QWindow* shown = window_.windowHandle())
      connect(shown, &QWindow::screenChanged, this, [this] { find(display_file()); });
    find(display_file());
  });
}

void Display::ask() {
  const QString file = QFileDialog::getOpenFileName(
      &window_, tr("Profile of the display"),
      display_file().isEmpty() ? QStringLiteral("/usr/share/color/icc") : display_file(),
      tr("ICC profiles (*.icc *.icm)"));
  if (!file.isEmpty()) choose(file);
}

void Display::choose(const QString& file) {
  QSettings().setValue(display_setting, file);
  find(file);
}

void Display::find(const QString& file) {
  const QString output = window_.screen()->name();
  const auto work = [output, file] {
    return find_display(QDBusConnection::systemBus(),
                        QStringLiteral("org.freedesktop.ColorManager"), output, file);
  };
  on_pool(this, work, [this, number = ++asked_](const DisplayProfile& profile) {
    if (number != asked_) return;
    label_->setText(profile.told);
    bar_.set_display(profile.space);
  });
}

}  // namespace metamer::gui
