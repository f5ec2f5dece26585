#pragma once

#include <QAction>
#include <QHash>
#include <QObject>
#include <functional>
#include <span>

namespace metamer::gui {

/// Where an action's key works, and when it can be chosen.
enum class Context {
  always,
  text,      ///< A text is in front: a scene's or another.
  document,  ///< A scene is in front.
  picture,   ///< A picture has the focus; its key may be a single letter.
};

/// One thing that a user can do. Menus, the palette, the page of keys and the tests are made of the
/// table.
struct ActionRow {
  const char* id;    ///< "file.open"
  const char* menu;  ///< "File", "View/Device"; actions stand in it in the table's order.
  const char* text;  ///< With "&" before the letter that chooses it; "-" alone is a line.
  const char* key;   ///< As QKeySequence reads it; several apart by "; "; "": none.
  Context context = Context::always;
  const char* group = "";  ///< Actions of one group are choices: one of them is checked.
  bool checkable = false;
};

std::span<const ActionRow> action_table();

/// The actions of one window, by id.
class Actions : public QObject {
  Q_OBJECT
 public:
  explicit Actions(QObject* parent);

  /// Never null for an id of the table.
  QAction* operator[](const QString& id) const;
  /// What is done when it is chosen. An action that nothing was bound to is disabled.
  void bind(const QString& id, std::function<void()> done);
  /// The same of a checkable action: with its new state.
  void bind_toggle(const QString& id, std::function<void(bool)> done);
  bool is_bound(const QString& id) const { return bound_.contains(id); }
  /// Why it can't be chosen whatever is in front, which its tool tip says; empty: it can.
  void forbid(const QString& id, const QString& why);
  /// Enables and disables by context.
  void set_context(bool text, bool document, bool picture);

 private:
  QHash<QString, QAction*> actions_;
  QHash<QString, bool> bound_;
  QHash<QString, QString> forbidden_;  ///< With their usual tool tips.
  bool text_ = false, document_ = false, picture_ = false;
};

}  // namespace metamer::gui
