#include "jobs_window.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QTest>

namespace metamer::test {

bool comes(const std::function<bool()>& condition, int seconds) {
  return QTest::qWaitFor(condition, 1000 * seconds);
}

std::string blink_scene(const std::string& settings) {
  return R"(
camera { eye { y: 1.2 z: 4 } target { y: 0.6 } vertical_fov: 40 }
light { name: "lamp" position { x: 1 y: 3 z: 2 } spectrum { standard: "A" } luminance: 0.8 }
light { name: "sun" direction { x: 1 y: -2 z: -1 } spectrum { standard: "D65" } luminance: 0.4 }
material { name: "floor" diffuse { samples { wavelength: 400 wavelength: 700 value: 0.2 value: 0.7 } }
           specular { constant: 1 } mirror: 0.2 }
material { name: "ball" diffuse { samples { wavelength: 400 wavelength: 700 value: 0.8 value: 0.1 } }
           specular { constant: 1 } diffuseness: 0.7 specularness: 0.3 blinn_phong { shininess: 60 } }
object { name: "floor" material: "floor" quad { corner { x: -3 z: 2 } u { x: 6 } v { z: -5 } } }
object { name: "ball" material: "ball" sphere { center { y: 0.6 } radius: 0.6 } }
settings { )" +
         settings + " }\n";
}

void JobsWindow::write(const QString& name, const std::string& text) {
  QFile file(path(name));
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write(QByteArray::fromStdString(text));
}

JobsWindow::JobsWindow(const std::string& scene) {
  write(QStringLiteral("scene.txtpb"), scene);
  write(QStringLiteral("bad.ply"), "no mesh at all");
  link_.open({});
  window_.open(path(QStringLiteral("scene.txtpb")));
  window_.show();
  EXPECT_TRUE(comes([this] { return link_.ready(); }));
  EXPECT_TRUE(comes([this] { return document().sound() != nullptr; }));
}

void JobsWindow::choose(const char* action) {
  QAction* chosen = window_.actions()[QString::fromUtf8(action)];
  ASSERT_TRUE(chosen->isEnabled()) << action;
  chosen->trigger();
}

gui::JobPage* JobsWindow::job() {
  auto* page = qobject_cast<gui::JobPage*>(window_.picture_page());
  EXPECT_NE(page, nullptr) << "the page in front shows no job";
  return page;
}

}  // namespace metamer::test
