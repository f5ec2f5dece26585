#include "client/gui/looks/settings_actions.h"

#include <algorithm>
#include <array>

#include "client/gui/looks/look_command.h"
#include "client/tools/scene/look_change.h"

namespace metamer::gui {
namespace {

using Settings = v1::Settings;

/// A setting that is an enumeration, and the action of each of its values, in its order.
struct Choice {
  const char* name;
  const char* path;
  std::vector<const char*> actions;
  int (*value)(const Settings&);
  void (*set)(int, client::Look&);
};

template <class Change>
void set_choice(const char* path, const Change& change, client::Look& look) {
  Settings settings;
  change(settings);
  client::set_setting(path, settings, look);
}

const std::array<Choice, 4>& setting_choices() {
  static const std::array<Choice, 4> all{{
      {"Device",
       "backend",
       {"view.device.cpu", "view.device.gl"},
       [](const Settings& settings) { return int{settings.backend()}; },
       [](int value, client::Look& look) {
         set_choice(
             "backend", [&](Settings& to) { to.set_backend(v1::Backend(value)); }, look);
       }},
      {"Lighting",
       "shading",
       {"view.lighting.phong", "view.lighting.constant", "view.lighting.gouraud",
        "view.lighting.quadratic"},
       [](const Settings& settings) { return int{settings.shading()}; },
       [](int value, client::Look& look) {
         set_choice(
             "shading", [&](Settings& to) { to.set_shading(v1::Shading(value)); }, look);
       }},
      {"Observer",
       "observer",
       {"light.observer.2", "light.observer.10"},
       [](const Settings& settings) {
         return settings.observer_file().empty() ? int{settings.observer()} : -1;
       },
       [](int value, client::Look& look) { client::set_observer(v1::Observer(value), look); }},
      {"Adaptation",
       "development.adaptation",
       {"light.adaptation.none", "light.adaptation.von_kries", "light.adaptation.bradford",
        "light.adaptation.sharp", "light.adaptation.cmccat2000"},
       [](const Settings& settings) {
         return settings.development().has_adaptation() ? int{settings.development().adaptation()}
                                                        : 0;
       },
       [](int value, client::Look& look) {
         set_choice(
             "development.adaptation",
             [&](Settings& to) { to.mutable_development()->set_adaptation(v1::Adaptation(value)); },
             look);
       }},
  }};
  return all;
}

int shown_choice(const Choice& choice, const Document& document) {
  if (!document.sound()) return -1;
  v1::Scene scene = client::without_objects(document.sound()->scene());
  return client::apply(document.look(), scene) ? choice.value(scene.settings()) : -1;
}

void choose(MainWindow& window, const Choice& choice, int value) {
  Document* document = window.document();
  if (document == nullptr || shown_choice(choice, *document) == value) return;
  const QAction* action =
      window.actions()[QString::fromUtf8(choice.actions[static_cast<std::size_t>(value)])];
  client::Look look = document->look();
  choice.set(value, look);
  document->undo().push(
      new LookCommand(*document, std::move(look), action->text().remove(QLatin1Char('&'))));
}

/// The one after the one that is shown.
void choose_next_value(MainWindow& window, const Choice& choice) {
  if (Document* document = window.document())
    choose(window, choice,
           (shown_choice(choice, *document) + 1) % static_cast<int>(choice.actions.size()));
}

}  // namespace

QList<ChoiceMenu> choice_menus() {
  QList<ChoiceMenu> menus;
  for (const Choice& choice : setting_choices()) {
    ChoiceMenu menu{.name = QObject::tr(choice.name), .actions = {}};
    for (const char* action : choice.actions) menu.actions << QString::fromUtf8(action);
    menus << menu;
  }
  return menus;
}

void bind_settings(MainWindow& window) {
  for (const Choice& choice : setting_choices())
    for (std::size_t i = 0; i < choice.actions.size(); ++i)
      window.actions().bind(QString::fromUtf8(choice.actions[i]),
                            [&window, &choice, i] { choose(window, choice, static_cast<int>(i)); });
  window.actions().bind(QStringLiteral("view.device.other"),
                        [&window] { choose_next_value(window, setting_choices()[0]); });
  window.actions().bind(QStringLiteral("view.lighting.next"),
                        [&window] { choose_next_value(window, setting_choices()[1]); });
}

void check_settings(const Settings& settings, Actions& actions) {
  for (const Choice& choice : setting_choices()) {
    const int value = choice.value(settings);
    for (std::size_t i = 0; i < choice.actions.size(); ++i)
      actions[QString::fromUtf8(choice.actions[i])]->setChecked(static_cast<int>(i) == value);
  }
}

}  // namespace metamer::gui
