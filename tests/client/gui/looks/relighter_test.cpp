// A finished picture under another look is what `metamer relight` makes of its factors.
#include <gtest/gtest.h>

#include <QProcess>

#include "client/relight/factors.h"
#include "tests/client/gui/jobs/jobs_window.h"

namespace metamer::test {
namespace {

/// A rendered page whose picture has factors.
gui::JobPage* rendered_page(JobsWindow& test) {
  test.choose("render.render");
  gui::JobPage* page = test.job();
  EXPECT_TRUE(comes([page] { return page->picture().has_value(); }));
  EXPECT_TRUE(page->picture() && page->picture()->factors);
  return page;
}

TEST(Relighter, AfterKey2ThePictureIsThatOfMetamerRelightByteForByte) {
  JobsWindow test(blink_scene("width: 75 height: 53 spp: 4"));
  gui::JobPage* page = rendered_page(test);
  const QImage before = page->canvas().image().copy();
  test.choose("light.look.2");
  ASSERT_TRUE(comes([page] { return page->picture()->relit != nullptr; }));

  const QString factors = test.path(QStringLiteral("kept.factors")),
                png = test.path(QStringLiteral("relit.png"));
  ASSERT_TRUE(client::write_factors(*page->rendered()->factors, factors.toStdString()));
  QProcess metamer;
  metamer.start(QStringLiteral(METAMER_BIN "/metamer"),
                {QStringLiteral("relight"), factors, QStringLiteral("--light"),
                 QStringLiteral("*=A"), QStringLiteral("-o"), png});
  ASSERT_TRUE(metamer.waitForFinished(60'000));
  ASSERT_EQ(metamer.exitCode(), 0) << metamer.readAllStandardError().toStdString();
  const QImage file(png), shown = page->canvas().image();
  ASSERT_EQ(shown.size(), file.size());
  for (int y = 0; y < file.height(); ++y)
    for (int x = 0; x < file.width(); ++x)
      ASSERT_EQ(shown.pixel(x, y), file.pixel(x, y)) << x << ", " << y;
  EXPECT_NE(shown, before);

  test.choose("light.look.none");
  EXPECT_TRUE(comes([page] { return page->picture()->relit == nullptr; }));
  EXPECT_EQ(page->canvas().image(), before);
}

TEST(Relighter, AMovedCameraLeavesAFinishedPictureItsOwn) {
  JobsWindow test(blink_scene("width: 32 height: 24 spp: 1"));
  gui::JobPage* page = rendered_page(test);
  v1::Camera moved;
  moved.mutable_eye()->set_z(9);
  test.document().set_camera(moved);
  test.choose("light.look.2");
  EXPECT_TRUE(comes([page] { return page->picture()->relit != nullptr; }));
}

}  // namespace
}  // namespace metamer::test
