#pragma once

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <functional>

#include "client/gui/app/main_window.h"
#include "client/gui/looks/look_bar.h"

namespace metamer::gui {

/// A window without a server on a scene with two lights, two paints and these looks.
class LookedScene : public testing::Test {
 protected:
  static constexpr const char* without_looks = R"(camera { eye { z: 4 } target {} }
light { name: "key" position { z: 4 } spectrum { standard: "D65" } }
light { name: "fill" position { x: 4 } spectrum { standard: "D65" } }
material { name: "red" diffuse { file: "red.txt" } diffuseness: 1 }
material { name: "grey" diffuse { constant: 0.5 } diffuseness: 1 }
object { name: "ball" material: "red" sphere { radius: 1 } }
)";
  static constexpr const char* looks = R"(
look { name: "day" light { name: "*" spectrum { standard: "D65" } } }
look { name: "A" light { name: "*" spectrum { standard: "A" } } }
look { name: "shop & home" light { name: "key" spectrum { standard: "F11" } } observer: CIE_1964_10DEG
  material { name: "grey" diffuse { constant: 0.2 } } camera { eye { x: 4 } target {} } }
)";

  void SetUp() override { write("red.txt", "400 0.1\n700 0.9\n"); }

  void write(const char* name, const QByteArray& text) const {
    QFile file(folder.filePath(QString::fromUtf8(name)));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly | QIODevice::Truncate));
    file.write(text);
  }

  void open(const QByteArray& text) {
    write("scene.txtpb", text);
    window.open(folder.filePath(QStringLiteral("scene.txtpb")));
    ASSERT_TRUE(wait([&] { return window.document()->sound() != nullptr; }));
  }

  static bool wait(const std::function<bool()>& condition) {
    return QTest::qWaitFor(condition, 10'000);
  }

  QAction* action(const QString& id) { return window.actions()[id]; }
  LookBar* bar() { return window.findChild<LookBar*>(); }
  /// As it is sent and shown.
  std::string effective() {
    const Result<v1::Scene> scene = window.document()->effective();
    return scene ? scene->DebugString() : scene.error().message;
  }

  QTemporaryDir folder;
  Link link;
  MainWindow window{link};
};

}  // namespace metamer::gui
