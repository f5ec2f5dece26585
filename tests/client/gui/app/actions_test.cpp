#include "client/gui/app/actions.h"

#include <gtest/gtest.h>

#include <QMenuBar>
#include <map>
#include <set>

#include "client/gui/app/main_window.h"

namespace metamer::gui {
namespace {

TEST(Actions, EachHasATextAMenuAndAnIdOfItsOwn) {
  std::set<std::string> ids;
  for (const ActionRow& row : action_table()) {
    EXPECT_TRUE(ids.insert(row.id).second) << row.id;
    EXPECT_STRNE(row.text, "") << row.id;
    EXPECT_STRNE(row.menu, "") << row.id;
  }
}

TEST(Actions, NoKeyIsAnothersWhereBothWork) {
  QObject owner;
  Actions actions(&owner);
  std::map<std::string, std::string> keys;
  for (const ActionRow& row : action_table())
    for (const QKeySequence& key : actions[QString::fromUtf8(row.id)]->shortcuts()) {
      const auto [there, fresh] = keys.emplace(key.toString().toStdString(), row.id);
      EXPECT_TRUE(fresh) << row.id << " has the key of " << there->second;
      EXPECT_FALSE(key.isEmpty()) << row.id << ": " << row.key << " is no key";
    }
}

TEST(Actions, AllStandInTheMenusOfTheWindow) {
  Link link;
  MainWindow window(link);
  std::set<QAction*> found;
  const std::function<void(const QList<QAction*>&)> collect = [&](const QList<QAction*>& actions) {
    for (QAction* action : actions) {
      found.insert(action);
      if (action->menu() != nullptr) collect(action->menu()->actions());
    }
  };
  collect(window.menuBar()->actions());
  for (const ActionRow& row : action_table())
    EXPECT_TRUE(found.contains(window.actions()[QString::fromUtf8(row.id)])) << row.id;
}

}  // namespace
}  // namespace metamer::gui
