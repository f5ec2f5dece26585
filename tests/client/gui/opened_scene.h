#pragma once

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <functional>

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// A window, without a server, on a scene in a folder of its own.
class OpenedScene : public testing::Test {
 protected:
  static constexpr const char* sound = R"(# A ball.
camera { eye { z: 4 } target {} }
light { name: "lamp" position { z: 4 } spectrum { standard: "D65" } }
material { name: "red" diffuse { file: "red.txt" } diffuseness: 1 }
object { name: "ball" material: "red" sphere { radius: 1 } }
)";

  void SetUp() override { write(QStringLiteral("red.txt"), "400 0.1\n700 0.9\n"); }

  QString path(const QString& name) const { return folder.filePath(name); }

  void write(const QString& name, const QByteArray& text) const {
    QFile file(path(name));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly | QIODevice::Truncate));
    file.write(text);
  }

  /// Opens a text as scene.txtpb, and waits for its check.
  void open(const QByteArray& text) {
    write(QStringLiteral("scene.txtpb"), text);
    window.open(path(QStringLiteral("scene.txtpb")));
    ASSERT_TRUE(wait([&] { return window.document()->checked() != nullptr; }));
  }

  static QByteArray replaced(const char* before, const char* after) {
    QByteArray text(sound);
    EXPECT_TRUE(text.contains(before));
    return text.replace(before, after);
  }

  static bool wait(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 10'000);
  }

  QAction* action(const char* id) { return window.actions()[QString::fromUtf8(id)]; }

  QTemporaryDir folder;
  Link link;
  MainWindow window{link};
};

}  // namespace metamer::gui
