#include "client/gui/jobs/job_page.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QProcess>
#include <QPushButton>

#include "jobs_window.h"

namespace metamer::test {
namespace {

/// A picture that takes its time on any machine.
std::string endless_job() { return blink_scene("width: 2048 height: 2048 spp: 1024 tile_size: 8"); }

/// Whether some label of the page reads so.
bool reads(const QWidget& page, const QString& text) {
  for (const QLabel* label : page.findChildren<QLabel*>())
    if (label->text().contains(text)) return true;
  return false;
}

QPushButton* button(const QWidget& page, const QString& text) {
  for (QPushButton* one : page.findChildren<QPushButton*>())
    if (one->text() == text) return one;
  return nullptr;
}

TEST(JobWatch, WhatIsShownOfAPictureThatGrowsTakesNoMoreThan16MiB) {
  for (const QSize& size : {QSize(1, 1), QSize(640, 480), QSize(2048, 2048), QSize(2049, 2048),
                            QSize(8192, 8192), QSize(16384, 16384), QSize(16384, 1)}) {
    const QSize grown = gui::grown_size(size);
    const int side = gui::growth_side(size);
    EXPECT_LE(qint64{4} * grown.width() * grown.height(), qint64{16} << 20) << size.width();
    EXPECT_GE(grown.width() * side, size.width());
    EXPECT_LT((grown.width() - 1) * side, size.width());
  }
  EXPECT_EQ(gui::growth_side({2048, 2048}), 1) << "small ones grow as they are";
  EXPECT_EQ(gui::growth_side({8192, 8192}), 4);
}

TEST(JobPage, AFinishedPictureIsThatOfMetamerRenderByteForByte) {
  JobsWindow test(blink_scene("width: 75 height: 53 spp: 4"));
  test.choose("render.render");
  const auto* page = test.job();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(comes([page] { return page->picture().has_value(); }));

  const QString png = test.path(QStringLiteral("by_metamer.png"));
  QProcess metamer;
  metamer.start(QStringLiteral(METAMER_BIN "/metamer"),
                {QStringLiteral("render"), test.path(QStringLiteral("scene.txtpb")),
                 QStringLiteral("-o"), png});
  ASSERT_TRUE(metamer.waitForFinished(60'000));
  ASSERT_EQ(metamer.exitCode(), 0) << metamer.readAllStandardError().toStdString();
  const QImage file(png);
  const QImage shown = const_cast<gui::JobPage*>(page)->canvas().image();
  ASSERT_EQ(shown.size(), QSize(75, 53));
  ASSERT_EQ(shown.size(), file.size());
  for (int y = 0; y < file.height(); ++y)
    for (int x = 0; x < file.width(); ++x)
      ASSERT_EQ(shown.pixel(x, y), file.pixel(x, y)) << x << ", " << y;

  const gui::Picture& picture = *page->picture();
  EXPECT_EQ(picture.xyz->width, 75);
  EXPECT_EQ(picture.plan->spp(), 4U);
  ASSERT_NE(picture.factors, nullptr) << "jobs of the cpu keep them";
  EXPECT_EQ(picture.factors->end.size(), 75U * 53U);
  EXPECT_TRUE(page->title().endsWith(QStringLiteral("✓"))) << page->title().toStdString();
  EXPECT_TRUE(reads(*page, QStringLiteral("in all")));
}

TEST(JobPage, SpacePausesAndGoesOnAndEscCancels) {
  JobsWindow test(endless_job());
  test.choose("render.render");
  auto* page = test.job();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(comes([page] { return page->title().contains(QLatin1Char('%')); }));
  EXPECT_TRUE(reads(*page, QStringLiteral("2048x2048, 1024 samples")));
  test.choose("render.pause");
  ASSERT_TRUE(comes([page] { return page->panel().paused(); }));
  EXPECT_NE(button(*page, QStringLiteral("Go on")), nullptr);
  test.choose("render.pause");
  ASSERT_TRUE(comes([page] { return !page->panel().paused(); }));
  test.choose("render.cancel");
  ASSERT_TRUE(comes([page] { return page->panel().ended(); }));
  EXPECT_TRUE(reads(*page, QStringLiteral("cancelled")));
  EXPECT_TRUE(page->title().endsWith(QStringLiteral("✗")));
  EXPECT_FALSE(page->picture());
}

TEST(JobPage, AFailedJobSaysWhy) {
  JobsWindow test(blink_scene("width: 20 height: 20") +
                  "object { name: \"bad\" material: \"ball\" mesh { file: \"bad.ply\" } }\n");
  test.choose("render.render");
  auto* page = test.job();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(comes([page] { return page->panel().ended(); }));
  EXPECT_TRUE(page->title().endsWith(QStringLiteral("✗")));
  EXPECT_TRUE(reads(*page, QStringLiteral("failed")));
  EXPECT_TRUE(reads(*page, QStringLiteral("bad.ply"))) << "where it is wrong";
  EXPECT_FALSE(page->picture());
}

TEST(JobPage, ThePromiseIsKeptOrBrokenWithItsTwoNumbers) {
  JobsWindow test(blink_scene("width: 75 height: 53 spp: 4 goal { tolerance: 0.5 }"));
  test.choose("render.render");
  auto* page = test.job();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(comes([page] { return page->picture().has_value(); }));
  EXPECT_TRUE(reads(*page, QStringLiteral("✓ promise kept: ΔE00 at most ")));
  EXPECT_TRUE(reads(*page, QStringLiteral("at most 0.5 was asked for")));
}

TEST(JobPage, ABrokenPromiseOffersExact) {
  // No picture takes so little time.
  JobsWindow test(blink_scene("width: 75 height: 53 spp: 4 goal { deadline: 1e-6 }"));
  test.choose("render.render");
  auto* page = test.job();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(comes([page] { return page->picture().has_value(); }));
  EXPECT_TRUE(reads(*page, QStringLiteral("✗ promise broken: it took ")));
  EXPECT_TRUE(reads(*page, QStringLiteral("1e-06 s were asked for")));
  QPushButton* exact = button(*page, QStringLiteral("Render by exact"));
  ASSERT_NE(exact, nullptr);
  ASSERT_TRUE(exact->isVisibleTo(page));
  exact->click();
  auto* again = test.job();
  ASSERT_NE(again, page);
  ASSERT_TRUE(comes([again] { return again->picture().has_value(); }));
  EXPECT_TRUE(again->picture()->plan->method().has_exact());
  EXPECT_FALSE(again->picture()->plan->has_auto_());
}

TEST(JobPage, WhatWasTypedJustBeforeIsRendered) {
  JobsWindow test(blink_scene("width: 20 height: 15 spp: 1"));
  test.document().set_text(QString(test.document().text())
                               .replace(QStringLiteral("width: 20"), QStringLiteral("width: 31")));
  test.choose("render.render");
  ASSERT_TRUE(comes([&] { return qobject_cast<gui::JobPage*>(test.window().picture_page()); }));
  auto* page = test.job();
  ASSERT_TRUE(comes([page] { return page->picture().has_value(); }));
  EXPECT_EQ(page->picture()->xyz->width, 31);
}

TEST(JobPage, ASceneWithProblemsIsNotSent) {
  JobsWindow test(blink_scene("width: 20 height: 20"));
  test.document().set_text(test.document().text() + QStringLiteral("nonsense"));
  ASSERT_TRUE(comes([&] { return !test.document().checked()->sound(); }));
  const int pages = test.window().pictures().count();
  test.choose("render.render");
  EXPECT_EQ(test.window().pictures().count(), pages);
}

}  // namespace
}  // namespace metamer::test
