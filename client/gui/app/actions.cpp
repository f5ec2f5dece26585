#include "client/gui/app/actions.h"

#include <QActionGroup>
#include <QMenu>

namespace metamer::gui {
namespace {

QList<QKeySequence> keys_of(const ActionRow& row) {
  QList<QKeySequence> keys;
  for (const QString& key :
       QString::fromUtf8(row.key).split(QStringLiteral("; "), Qt::SkipEmptyParts))
    keys << QKeySequence(key);
  return keys;
}

}  // namespace

Actions::Actions(QObject* parent) : QObject(parent) {
  QHash<QString, QActionGroup*> groups;
  for (const ActionRow& row : action_table()) {
    const QString id = QString::fromUtf8(row.id);
    auto* action = new QAction(tr(row.text), this);
    action->setObjectName(id);
    action->setShortcuts(keys_of(row));
    // A picture's keys work in the window that shows it, and leave letters to the editor.
    if (row.context == Context::picture) action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    action->setCheckable(row.checkable || *row.group != '\0');
    if (*row.group != '\0') {
      QActionGroup*& group = groups[QString::fromUtf8(row.group)];
      if (group == nullptr) group = new QActionGroup(this);
      group->addAction(action);
    }
    action->setEnabled(false);
    actions_.insert(id, action);
  }
}

QAction* Actions::operator[](const QString& id) const {
  QAction* action = actions_.value(id);
  Q_ASSERT(action != nullptr);
  return action;
}

void Actions::bind(const QString& id, std::function<void()> done) {
  bound_.insert(id, true);
  QAction* action = (*this)[id];
  action->setEnabled(true);
  connect(action, &QAction::triggered, this, [done = std::move(done)] { done(); });
}

void Actions::bind_toggle(const QString& id, std::function<void(bool)> done) {
  bound_.insert(id, true);
  QAction* action = (*this)[id];
  action->setEnabled(true);
  connect(action, &QAction::toggled, this, std::move(done));
}

void Actions::forbid(const QString& id, const QString& why) {
  QAction* action = (*this)[id];
  if (!why.isEmpty() && !forbidden_.contains(id)) forbidden_.insert(id, action->toolTip());
  action->setToolTip(why.isEmpty() && forbidden_.contains(id) ? forbidden_.take(id) : why);
  for (QObject* place : action->associatedObjects())
    if (auto* menu = qobject_cast<QMenu*>(place)) menu->setToolTipsVisible(!why.isEmpty());
  set_context(text_, document_, picture_);
}

void Actions::set_context(bool text, bool document, bool picture) {
  text_ = text;
  document_ = document;
  picture_ = picture;
  for (const ActionRow& row : action_table()) {
    const QString id = QString::fromUtf8(row.id);
    const bool there = row.context == Context::always || (row.context == Context::text && text) ||
                       (row.context == Context::document && document) ||
                       (row.context == Context::picture && picture);
    (*this)[id]->setEnabled(there && is_bound(id) && !forbidden_.contains(id));
  }
}

}  // namespace metamer::gui
