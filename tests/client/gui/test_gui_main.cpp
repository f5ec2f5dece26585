// Tests of the window: one application for all of them, without a screen. A warning of Qt's fails
// its test.
#include <gtest/gtest.h>

#include <QApplication>
#include <QDir>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>

namespace {

void fail_on_warning(QtMsgType type, const QMessageLogContext&, const QString& text) {
  // The offscreen platform says this of every window, and of lists that open.
  if (text.startsWith(QStringLiteral("This plugin does not support"))) return;
  if (type == QtWarningMsg || type == QtCriticalMsg)
    ADD_FAILURE() << "Qt warns: " << text.toStdString();
}

}  // namespace

int main(int count, char** words) {
  ::testing::InitGoogleTest(&count, words);
  if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  const QString runtime = qEnvironmentVariable("XDG_RUNTIME_DIR");
  if (!runtime.isEmpty()) {
    QDir().mkpath(runtime);
    QFile::setPermissions(runtime, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  }
  QStandardPaths::setTestModeEnabled(true);
  // Tests run side by side: each process has settings of its own.
  const QTemporaryDir settings;
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
  QApplication application(count, words);
  QApplication::setApplicationName(QStringLiteral("test_gui"));
  qInstallMessageHandler(fail_on_warning);
  return RUN_ALL_TESTS();
}
