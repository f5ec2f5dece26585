#include "client/gui/jobs/save_picture.h"

#include <gtest/gtest.h>

#include <QColorSpace>

#include "common/image/spectral_exr.h"
#include "jobs_window.h"

namespace metamer::test {
namespace {

using gui::PictureFormat;

TEST(SavePicture, WritesEachFormatOfAJobsPicture) {
  JobsWindow test(blink_scene("width: 20 height: 15 spp: 4 method { rgb {} }"));
  test.choose("render.render");
  auto* page = test.job();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(comes([page] { return page->picture().has_value(); }));
  const gui::Picture& picture = *page->picture();
  const auto save = [&](const char* name, PictureFormat format) {
    const QString file = test.path(QString::fromUtf8(name));
    const Result<QStringList> said = gui::save_picture(picture, file, format);
    EXPECT_TRUE(said) << metamer::format(said.error());
    return said ? *said : QStringList();
  };

  save("eight.png", PictureFormat::png);
  QImage png(test.path(QStringLiteral("eight.png")));
  png.setColorSpace({});
  EXPECT_EQ(png.convertToFormat(QImage::Format_RGB32), page->canvas().image());
  page->canvas().one_to_one();
  const QPoint corner = page->canvas().place_of({0, 0}).toPoint();
  EXPECT_EQ(page->canvas()
                .grab(QRect(corner, png.size()))
                .toImage()
                .convertToFormat(QImage::Format_RGB32),
            page->canvas().image())
      << "at 1:1 on the screen too";
  save("sixteen.png", PictureFormat::png_16);
  EXPECT_EQ(QImage(test.path(QStringLiteral("sixteen.png"))).depth(), 64);
  save("xyz.exr", PictureFormat::exr_xyz);
  const auto xyz = read_image(test.path(QStringLiteral("xyz.exr")).toStdString());
  ASSERT_TRUE(xyz);
  EXPECT_EQ(xyz->pixels, picture.xyz->pixels) << "bit for bit";
  save("linear.exr", PictureFormat::exr);
  const auto linear = read_image(test.path(QStringLiteral("linear.exr")).toStdString());
  ASSERT_TRUE(linear);
  EXPECT_EQ(linear->channels, (std::vector<std::string>{"R", "G", "B"}));
  const QStringList said = save("spectra.exr", PictureFormat::exr_spectral);
  EXPECT_TRUE(said.join(QString()).contains(QStringLiteral("exact method")))
      << said.join(QString()).toStdString();
}

TEST(SavePicture, OffersSpectraOnlyWhereThereAreFactors) {
  gui::Picture picture;
  EXPECT_FALSE(gui::formats_of(picture).contains(PictureFormat::exr_spectral));
  picture.factors = std::make_shared<const client::Factors>();
  EXPECT_TRUE(gui::formats_of(picture).contains(PictureFormat::exr_spectral));
}

TEST(SavePicture, SaysWhyItCannot) {
  gui::Picture picture;
  picture.xyz = std::make_shared<const Image>(make_image(2, 2, {"X", "Y", "Z"}));
  EXPECT_FALSE(gui::save_picture(picture, QStringLiteral("a.png"), PictureFormat::png));
  picture.plan = std::make_shared<const v1::Plan>();
  EXPECT_FALSE(gui::save_picture(picture, QStringLiteral("/nowhere/a.png"), PictureFormat::png));
  EXPECT_FALSE(gui::save_picture(picture, QStringLiteral("a.exr"), PictureFormat::exr_spectral));
}

}  // namespace
}  // namespace metamer::test
