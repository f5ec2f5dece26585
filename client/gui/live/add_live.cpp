#include "client/gui/live/add_live.h"

#include <functional>

#include "client/tools/scene/camera_motion.h"

namespace metamer::gui {
namespace {

constexpr double turn = 5;      // degrees a key
constexpr double shift = 0.05;  // of the picture's height a key
constexpr double nearer = 0.9;  // of the distance a key

using Motion = std::function<v1::Camera(const v1::Camera&)>;

void bind_motion(MainWindow& window, const char* id, Motion motion) {
  window.actions().bind(QString::fromUtf8(id), [&window, motion = std::move(motion)] {
    LivePage* live = window.live();
    if (live != nullptr && live->document().sound()) live->set_camera(motion(live->camera()));
  });
}

void bind_camera(MainWindow& window) {
  using client::dolly, client::elevate, client::orbit, client::pan;
  bind_motion(window, "view.orbit.left", [](const auto& camera) { return orbit(camera, -turn); });
  bind_motion(window, "view.orbit.right", [](const auto& camera) { return orbit(camera, turn); });
  bind_motion(window, "view.orbit.up", [](const auto& camera) { return elevate(camera, turn); });
  bind_motion(window, "view.orbit.down", [](const auto& camera) { return elevate(camera, -turn); });
  bind_motion(window, "view.pan.left", [](const auto& camera) { return pan(camera, -shift, 0); });
  bind_motion(window, "view.pan.right", [](const auto& camera) { return pan(camera, shift, 0); });
  bind_motion(window, "view.pan.up", [](const auto& camera) { return pan(camera, 0, shift); });
  bind_motion(window, "view.pan.down", [](const auto& camera) { return pan(camera, 0, -shift); });
  bind_motion(window, "view.dolly.in", [](const auto& camera) { return dolly(camera, nearer); });
  bind_motion(window, "view.dolly.out",
              [](const auto& camera) { return dolly(camera, 1 / nearer); });
}

}  // namespace

void add_live(MainWindow& window) {
  Actions& actions = window.actions();
  actions.bind(QStringLiteral("view.live"), [&window] {
    window.live()->set_live(!window.live()->goes_on());
    window.show_picture(window.live(), {});
    window.say(window.live()->live() ? MainWindow::tr("the live view goes on")
                                     : MainWindow::tr("the live view is paused"));
  });
  actions.bind(QStringLiteral("view.home"), [&window] { window.live()->home(); });
  actions[QStringLiteral("view.info")]->setChecked(true);
  actions.bind_toggle(QStringLiteral("view.info"), [&window](bool shown) {
    if (window.live() != nullptr) window.live()->show_info(shown);
  });
  bind_camera(window);
}

}  // namespace metamer::gui
