#include "client/gui/looks/look_bar.h"

#include <QInputDialog>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <utility>

#include "client/gui/app/on_pool.h"
#include "client/gui/looks/look_command.h"
#include "client/gui/looks/settings_actions.h"
#include "client/tools/scene/look_change.h"
#include "client/tools/scene/look_edit.h"
#include "common/problem.h"

namespace metamer::gui {
namespace {

constexpr int looks_with_keys = 9;  ///< Looks that have a key.

QString look_action(int index) { return QStringLiteral("light.look.%1").arg(index + 1); }

/// Text of an action: "&" before a letter chooses it, and two of them are one.
QString as_action_text(const std::string& name) {
  return QString::fromStdString(name).replace(QLatin1Char('&'), QStringLiteral("&&"));
}

}  // namespace

LookBar::LookBar(MainWindow& window) : QToolBar(tr("Looks"), &window), window_(window) {
  setObjectName(QStringLiteral("looks"));
  setMovable(false);
  auto* title = new QLabel(tr("Looks: "));
  addWidget(title);
  Actions& actions = window.actions();
  for (int i = 0; i < looks_with_keys; ++i) {
    actions.bind(look_action(i), [this, i] { choose(i); });
    looks_ << actions[look_action(i)];
  }
  actions.bind(QStringLiteral("light.look.none"), [this] { choose_none(); });
  actions[QStringLiteral("light.look.none")]->setIconText(tr("0 own"));
  addAction(actions[QStringLiteral("light.look.none")]);
  actions.bind(QStringLiteral("light.look.keep"), [this] { keep(); });
  keep_ = actions[QStringLiteral("light.look.keep")];
  actions.bind(QStringLiteral("edit.write_look"), [this] { write(); });
  keep_->setIconText(QStringLiteral("+"));
  keep_->setToolTip(tr("Keep the look as it is now"));
  addAction(keep_);
  addSeparator();
  for (const ChoiceMenu& choice : choice_menus()) add_choice(choice.name, choice.actions);
  for (QAction* look : looks_) {
    look->setCheckable(true);
    insertAction(actions[QStringLiteral("light.look.none")], look);
  }
  connect(&window, &MainWindow::document_chosen, this, &LookBar::follow_document);
  follow_document();
}

void LookBar::add_choice(const QString& name, const QStringList& ids) {
  auto* button = new QToolButton;
  auto* menu = new QMenu(button);
  button->setPopupMode(QToolButton::InstantPopup);
  button->setAccessibleName(name);
  button->setToolTip(name);
  button->setText(name);
  button->setMenu(menu);
  for (const QString& id : ids) {
    QAction* action = window_.actions()[id];
    menu->addAction(action);
    connect(action, &QAction::toggled, button, [button, action](bool chosen) {
      if (chosen) button->setText(action->iconText());
    });
  }
  addWidget(button);
}

void LookBar::follow_document() {
  if (document_ != nullptr) document_->disconnect(this);
  document_ = window_.document();
  if (document_ != nullptr) {
    connect(document_, &Document::checked_changed, this, &LookBar::list);
    connect(document_, &Document::look_changed, this, &LookBar::mark);
  }
  list();
}

void LookBar::list() {
  scene_.Clear();
  if (document_ != nullptr && document_->sound()) {
    scene_ = client::without_objects(document_->sound()->scene());
    if (scene_.look().empty()) client::add_standard_looks(scene_);
  }
  while (looks_.size() > looks_with_keys) delete looks_.takeLast();
  QAction* end = window_.actions()[QStringLiteral("light.look.none")];
  for (int i = 0; i < std::max(looks_with_keys, scene_.look_size()); ++i) {
    if (i == looks_.size()) {
      auto* look = new QAction(this);
      look->setCheckable(true);
      connect(look, &QAction::triggered, this, [this, i] { choose(i); });
      insertAction(end, look);
      looks_ << look;
    }
    looks_[i]->setVisible(i < scene_.look_size());
    if (i >= scene_.look_size()) continue;
    const QString name = as_action_text(scene_.look(i).name());
    looks_[i]->setText(i < looks_with_keys ? QStringLiteral("&%1 %2").arg(i + 1).arg(name) : name);
  }
  keep_->setVisible(scene_.light_size() > 0);
  mark();
}

/// A camera that was moved by hand counts for looks that have one.
bool LookBar::is_shown(const client::Look& chosen) const {
  client::Look now = document_->look();
  if (chosen.camera && document_->camera()) now.camera = document_->camera();
  return client::look_alike(chosen, now, scene_);
}

void LookBar::mark() {
  bool found = false;
  for (int i = 0; i < looks_.size(); ++i) {
    bool shown = false;
    if (i < scene_.look_size() && document_ != nullptr && !found) {
      const auto chosen = client::choose_look(document_->look(), scene_, scene_.look(i).name());
      shown = chosen && is_shown(*chosen);
    }
    looks_[i]->setChecked(shown);
    found = found || shown;
  }
  v1::Scene shown = scene_;
  if (document_ != nullptr && client::apply(document_->look(), shown))
    check_settings(shown.settings(), window_.actions());
}

void LookBar::choose(int index) {
  if (document_ == nullptr || index >= scene_.look_size()) return;
  const std::string& name = scene_.look(index).name();
  auto chosen = client::choose_look(document_->look(), scene_, name);
  if (chosen && !is_shown(*chosen))
    document_->undo().push(new LookCommand(*document_, std::move(*chosen),
                                           tr("look %1").arg(QString::fromStdString(name))));
  mark();
}

void LookBar::choose_none() {
  if (document_ == nullptr) return;
  client::Look own = client::without_look(document_->look());
  if (!client::look_alike(own, document_->look(), scene_))
    document_->undo().push(new LookCommand(*document_, std::move(own), tr("the scene's own look")));
  mark();
}

void LookBar::keep() {
  if (document_ == nullptr) return;
  bool given = false;
  const QString name =
      QInputDialog::getText(&window_, tr("Keep as a look"), tr("Name of the look:"),
                            QLineEdit::Normal, tr("look %1").arg(scene_.look_size() + 1), &given);
  if (given && !name.isEmpty()) keep_as(name);
}

void LookBar::keep_as(const QString& name) {
  for (const v1::Look& look : scene_.look())
    if (look.name() == name.toStdString())
      return window_.say(tr("there is a look named %1 already").arg(name));
  write_as(name);
}

void LookBar::write() {
  if (document_ == nullptr) return;
  QStringList names;
  QString proposed = tr("look %1").arg(scene_.look_size() + 1);
  for (int i = 0; i < scene_.look_size(); ++i) {
    names << QString::fromStdString(scene_.look(i).name());
    if (looks_[i]->isChecked()) proposed = names.back();
  }
  if (!names.contains(proposed)) names << proposed;
  bool given = false;
  const QString name =
      QInputDialog::getItem(&window_, tr("Write look into scene"),
                            tr("Name of the look; one of the scene's is replaced:"), names,
                            static_cast<int>(names.indexOf(proposed)), true, &given);
  if (given && !name.isEmpty()) write_as(name);
}

/// A look with a camera that was moved by hand has that one.
void LookBar::write_as(const QString& name) {
  client::Look look = document_->look();
  if (document_->camera()) look.camera = document_->camera();
  const auto make = [text = document_->text(), look, name, standard = scene_.look()] {
    return client::look_edit(text.toStdString(), look, name.toStdString(), standard);
  };
  on_pool(document_, make,
          [this, document = document_, text = document_->text(), name](const auto& edit) {
            if (!edit) return window_.say(QString::fromStdString(edit.error().message));
            SceneEditor* editor = window_.show_text(document);
            if (editor == nullptr || editor->text() != text)
              return window_.say(tr("the text was changed meanwhile: no look was written"));
            editor->replace(static_cast<int>(edit->begin), static_cast<int>(edit->end),
                            QString::fromStdString(edit->text));
            window_.say(tr("written into the scene as look %1").arg(name));
          });
}

}  // namespace metamer::gui
