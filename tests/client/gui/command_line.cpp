#include "tests/client/gui/command_line.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QJsonDocument>
#include <QProcess>

namespace metamer::gui {

QJsonObject answer_of(const QStringList& words) {
  QProcess process;
  process.start(QStringLiteral(METAMER_BIN "/metamer"),
                words + QStringList{QStringLiteral("--json")});
  EXPECT_TRUE(process.waitForFinished(30000)) << process.errorString().toStdString();
  const QJsonDocument answer = QJsonDocument::fromJson(process.readAllStandardOutput());
  EXPECT_TRUE(answer.isObject()) << words.join(QLatin1Char(' ')).toStdString();
  return answer.object();
}

void take_shot(QWidget& widget, const QString& name) {
  const QString folder = qEnvironmentVariable("METAMER_GUI_SHOTS");
  if (folder.isEmpty()) return;
  widget.show();
  QCoreApplication::processEvents();
  EXPECT_TRUE(widget.grab().save(folder + QLatin1Char('/') + name + QStringLiteral(".png")));
}

}  // namespace metamer::gui
