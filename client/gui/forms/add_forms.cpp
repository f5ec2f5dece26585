#include "client/gui/forms/add_forms.h"

#include "client/gui/forms/settings_dialog.h"
#include "client/gui/jobs/render_scene.h"
#include "client/gui/looks/look_command.h"
#include "client/tools/scene/settings_change.h"

namespace metamer::gui {
namespace {

void render_with(MainWindow& window, const v1::Settings& settings) {
  const auto ready = sendable(window);
  if (!ready) return;
  auto scene = std::make_shared<v1::Scene>(*ready->scene);
  *scene->mutable_settings() = settings;
  render_scene(window, scene, ready->assets, ready->name);
}

void use_for_live(Document& document, const v1::Settings& settings) {
  if (!document.sound()) return;
  client::Look look = document.look();
  client::set_settings(document.sound()->scene().settings(), settings, "the settings", look);
  document.undo().push(new LookCommand(document, std::move(look), MainWindow::tr("the settings")));
}

void show_settings(MainWindow& window) {
  const Result<v1::Scene> scene = window.document()->effective();
  if (!scene) return window.say(QString::fromStdString(scene.error().message));
  auto* dialog =
      new SettingsDialog(scene->settings(), window.link().status().welcome.capabilities(), &window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(dialog, &SettingsDialog::render_asked, &window,
                   [&window, dialog] { render_with(window, dialog->settings()); });
  QObject::connect(
      dialog, &SettingsDialog::live_asked, window.document(),
      [document = window.document(), dialog] { use_for_live(*document, dialog->settings()); });
  dialog->open();
}

}  // namespace

void add_forms(MainWindow& window) {
  window.actions().bind(QStringLiteral("render.settings"), [&window] { show_settings(window); });
}

}  // namespace metamer::gui
