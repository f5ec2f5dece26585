// Metamerism sheets: from a finished picture, or from a small one that is rendered for it.
#include <gtest/gtest.h>

#include <QFile>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "client/gui/sheet/sheet_page.h"
#include "client/relight/relight.h"
#include "tests/client/gui/jobs/jobs_window.h"

namespace metamer::gui {
namespace {

using metamer::test::comes;

/// The ball's paint, and another that is alike under equal energy and not under others.
std::string sheet_scene(const std::string& settings) {
  return metamer::test::blink_scene(settings) +
         "material { name: \"other\" diffuse { samples { wavelength: 400 wavelength: 550 "
         "wavelength: 700 value: 0.8 value: 0.3 value: 0.2 } } }\n";
}

SheetWish wish_of(const QStringList& lights, const QStringList& paints) {
  return {.lights = lights, .paints = paints, .painted = {}, .limit = 1};
}

class SheetTest : public testing::Test {
 protected:
  SheetPage& page() {
    test.choose("compare.sheet");
    auto* page = qobject_cast<SheetPage*>(test.window().picture_page());
    EXPECT_NE(page, nullptr);
    return *page;
  }
  bool made(SheetPage& page, const SheetWish& wish) {
    page.set_wish(wish);
    const auto before = page.sheet();
    Q_EMIT page.asked();
    return comes([&] { return page.sheet() != before; });
  }

  metamer::test::JobsWindow test{sheet_scene("width: 60 height: 40 spp: 1")};
};

TEST_F(SheetTest, WithoutAFinishedPictureASmallOneIsRenderedOnce) {
  SheetPage& sheet = page();
  ASSERT_TRUE(comes([&] { return sheet.sheet() != nullptr; }));
  ASSERT_TRUE(made(sheet, wish_of({"D65", "A", "F11"}, {"ball", "other"})));
  const client::Sheet& cells = sheet.sheet()->made.sheet;
  EXPECT_EQ(cells.lights, (std::vector<std::string>{"D65", "A", "F11"}));
  ASSERT_EQ(cells.candidates.size(), 3u);  // and what three numbers make of the first
  for (std::size_t i = 0; i < cells.cells.size(); ++i) {
    EXPECT_EQ(cells.cells[i].difference.has_value(), i >= 3) << i;
    // Three numbers are made for D65.
    if (i < 3) continue;
    EXPECT_EQ(cells.cells[i].difference->maximum > 0.5, i != 6) << i;
  }
  EXPECT_EQ(sheet.table().rowCount(), 3);
  EXPECT_TRUE(sheet.verdict().contains(QStringLiteral("other")));
}

TEST_F(SheetTest, TheReferencePaintByItselfPassesUnderAllLights) {
  SheetPage& sheet = page();
  ASSERT_TRUE(comes([&] { return sheet.sheet() != nullptr; }));
  ASSERT_TRUE(made(sheet, wish_of({"D65", "A"}, {"ball", "ball"})));
  for (int row = 0; row < sheet.table().rowCount(); ++row) {
    EXPECT_EQ(sheet.table().item(row, 2)->text(), QStringLiteral("0.00"));
    EXPECT_TRUE(sheet.table().item(row, 5)->text().startsWith(QStringLiteral("✓")));
  }
  EXPECT_TRUE(sheet.verdict().contains(QStringLiteral("all lights")));
}

TEST_F(SheetTest, OfThreePaintsTheNearerIsNamed) {
  SheetPage& sheet = page();
  ASSERT_TRUE(comes([&] { return sheet.sheet() != nullptr; }));
  ASSERT_TRUE(made(sheet, wish_of({"D65", "A"}, {"ball", "floor", "ball"})));
  EXPECT_TRUE(sheet.verdict().startsWith(QStringLiteral("ball is nearer to ball")));
  EXPECT_EQ(sheet.table().rowCount(), 4);
}

TEST_F(SheetTest, WhatCantBeMadeIsSaidAndTheSheetStays) {
  SheetPage& sheet = page();
  ASSERT_TRUE(comes([&] { return sheet.sheet() != nullptr; }));
  const auto before = sheet.sheet();
  const SheetWish wrong[] = {
      wish_of({"D65"}, {"ball", "other"}), wish_of({"D65", "F13"}, {"ball", "other"}),
      wish_of({"D65", "A"}, {"ball"}), wish_of({"D65", "A"}, {"ball", "D65"}),
      wish_of({"D65", "A"}, {"TCS01", "TCS02"})};
  for (const SheetWish& wish : wrong) {
    sheet.set_wish(wish);
    Q_EMIT sheet.asked();
    QTest::qWait(50);
    EXPECT_TRUE(comes([&] {
      for (const QPushButton* button : sheet.findChildren<QPushButton*>())
        if (button->text() == QStringLiteral("&Make the sheet")) return button->isEnabled();
      return false;
    }));
    EXPECT_EQ(sheet.sheet(), before);
  }
}

TEST_F(SheetTest, IsSavedAsAPngAndAPdf) {
  SheetPage& sheet = page();
  ASSERT_TRUE(comes([&] { return sheet.sheet() != nullptr; }));
  for (const char* name : {"sheet.png", "sheet.pdf"}) {
    const QString file = test.path(QString::fromUtf8(name));
    QSignalSpy saved(&sheet, &SheetPage::saved);
    sheet.save(file);
    ASSERT_TRUE(comes([&] { return saved.count() == 1; }));
    EXPECT_TRUE(saved[0][1].toString().isEmpty()) << saved[0][1].toString().toStdString();
    QFile written(file);
    ASSERT_TRUE(written.open(QIODevice::ReadOnly));
    EXPECT_GT(written.size(), 2000);
    const QByteArray head = written.read(5);
    EXPECT_TRUE(head.startsWith(name == std::string("sheet.pdf") ? "%PDF-" : "\x89PNG"));
  }
  QSignalSpy saved(&sheet, &SheetPage::saved);
  sheet.save(QStringLiteral("/nowhere/sheet.pdf"));
  ASSERT_TRUE(comes([&] { return saved.count() == 1; }));
  EXPECT_FALSE(saved[0][1].toString().isEmpty());
}

TEST_F(SheetTest, AFinishedPictureIsWhatTheSheetIsMadeOf) {
  test.choose("render.render");
  JobPage* job = test.job();
  ASSERT_TRUE(comes([job] { return job->picture().has_value(); }));
  SheetPage& sheet = page();
  ASSERT_TRUE(comes([&] { return sheet.sheet() != nullptr; }));
  // 60 pixels wide, six times as large on the sheet.
  EXPECT_EQ(sheet.sheet()->made.sheet.cells[0].picture.width, 360);
}

TEST(RelightRgb, IsThePictureThatTheMethodRgbRenders) {
  metamer::test::JobsWindow test(
      metamer::test::blink_scene("width: 40 height: 30 spp: 4 method { rgb {} }"));
  test.choose("render.render");
  JobPage* job = test.job();
  ASSERT_TRUE(comes([job] { return job->picture().has_value(); }));
  const Picture picture = *job->picture();
  ASSERT_TRUE(picture.factors);
  const Image relit =
      client::relight_rgb(*picture.factors, picture.factors->scene,
                          client::observer_of(*picture.plan, picture.factors->scene));
  ASSERT_EQ(relit.pixels.size(), picture.xyz->pixels.size());
  for (std::size_t i = 0; i < relit.pixels.size(); ++i)
    ASSERT_NEAR(relit.pixels[i], picture.xyz->pixels[i], 2e-5) << i;
}

}  // namespace
}  // namespace metamer::gui
