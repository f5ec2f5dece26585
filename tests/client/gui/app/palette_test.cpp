#include "client/gui/app/palette.h"

#include <gtest/gtest.h>

#include <QtTest>

#include "client/gui/app/keys_page.h"

namespace metamer::gui {
namespace {

TEST(Palette, FindsAnActionByWordsInAnyOrderAndRunsIt) {
  QObject owner;
  Actions actions(&owner);
  int opened = 0;
  actions.bind(QStringLiteral("file.booth"), [&] { ++opened; });
  actions.bind(QStringLiteral("file.quit"), [] {});
  Palette palette(actions, nullptr);
  EXPECT_EQ(palette.list().count(), 2);  // what nothing is bound to can't be chosen
  QTest::keyClicks(&palette.words(), QStringLiteral("booth DEMO"));
  EXPECT_EQ(palette.list().count(), 1);
  QTest::keyClick(&palette.words(), Qt::Key_Return);
  EXPECT_EQ(opened, 1);
}

TEST(Palette, DoesNothingWhereNoActionFits) {
  QObject owner;
  Actions actions(&owner);
  Palette palette(actions, nullptr);
  QTest::keyClicks(&palette.words(), QStringLiteral("no such thing"));
  QTest::keyClick(&palette.words(), Qt::Key_Down);
  QTest::keyClick(&palette.words(), Qt::Key_Return);
  EXPECT_EQ(palette.list().count(), 0);
}

TEST(KeysPage, HasARowForEachAction) {
  QObject owner;
  const Actions actions(&owner);
  const std::unique_ptr<QTableWidget> page(make_keys_page(actions));
  EXPECT_EQ(page->rowCount(), static_cast<int>(action_table().size()));
}

}  // namespace
}  // namespace metamer::gui
