// The window on a real screen: that of a virtual X server.
#include <gtest/gtest.h>

#include <QProcess>
#include <QScreen>
#include <QSet>
#include <QStandardPaths>
#include <QTest>
#include <QWindow>

#include "client/gui/app/add_app.h"
#include "client/gui/app/main_window.h"

namespace metamer::gui {
namespace {

/// An X server until its end; its display's name, ":7". It says itself when it can be had: xvfb-run
/// waits for a signal, which may come before it waits.
class XServer {
 public:
  explicit XServer(const QString& program) {
    server_.start(program,
                  {QStringLiteral("-displayfd"), QStringLiteral("1"), QStringLiteral("-screen"),
                   QStringLiteral("0"), QStringLiteral("1280x1024x24"), QStringLiteral("-nolisten"),
                   QStringLiteral("tcp")});
    while (!said_.endsWith('\n') && server_.waitForReadyRead(30'000)) said_ += server_.readAll();
  }
  ~XServer() {
    server_.terminate();
    server_.waitForFinished();
  }
  QString display() const {
    return QStringLiteral(":%1").arg(QString::fromLatin1(said_.trimmed()));
  }

 private:
  QProcess server_;
  QByteArray said_;
};

/// This test once more, on an X server.
void run_on_x(const QString& program) {
  const XServer server(program);
  ASSERT_NE(server.display(), QStringLiteral(":")) << "it has no display";
  QProcess self;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("xcb"));
  environment.insert(QStringLiteral("DISPLAY"), server.display());
  self.setProcessEnvironment(environment);
  self.setProcessChannelMode(QProcess::MergedChannels);
  self.start(QCoreApplication::applicationFilePath(), {QStringLiteral("--gtest_filter=Screen.*")});
  ASSERT_TRUE(self.waitForFinished(60'000)) << self.readAll().toStdString();
  EXPECT_EQ(self.exitStatus(), QProcess::NormalExit);
  EXPECT_EQ(self.exitCode(), 0) << self.readAll().toStdString();
}

TEST(Screen, TheWindowIsDrawnOnXAndClosesInOrder) {
  if (QGuiApplication::platformName() != QStringLiteral("xcb")) {
    const QString xvfb = QStandardPaths::findExecutable(QStringLiteral("Xvfb"));
    if (xvfb.isEmpty()) GTEST_SKIP() << "Xvfb is missing: the package xvfb of deploy/dependencies";
    return run_on_x(xvfb);
  }
  Link link;
  link.open({});
  MainWindow window(link);
  window.open(find_booth());
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.live()->frame() != nullptr; }, 30'000));
  QTest::qWait(200);
  const QImage shot = window.screen()->grabWindow(window.winId()).toImage();
  EXPECT_GE(shot.width(), 400);
  QSet<QRgb> colors;
  for (int y = 0; y < shot.height(); y += 3)
    for (int x = 0; x < shot.width(); x += 3) colors.insert(shot.pixel(x, y));
  EXPECT_GT(colors.size(), 200) << "the booth alone has more";
  window.close();  // it asks about jobs first
  EXPECT_TRUE(QTest::qWaitFor([&] { return !window.isVisible(); }, 10'000));
}

}  // namespace
}  // namespace metamer::gui
