// What plots look like, and what is saved of them.
#include <gtest/gtest.h>

#include <QTemporaryDir>
#include <cmath>

#include "client/gui/plot/plot_style.h"
#include "client/gui/plot/spectrum_plot.h"

namespace metamer::gui {
namespace {

/// WCAG 2.1: relative luminance, and contrast.
double wcag_luminance(const QColor& color) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}

double contrast(const QColor& one, const QColor& other) {
  const double a = wcag_luminance(one), b = wcag_luminance(other);
  return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
}

TEST(PlotStyle, CurvesAreSeenOnWhiteAndOnDarkGround) {
  QPalette dark = paper_palette();
  dark.setColor(QPalette::Base, QColor(30, 30, 30));
  dark.setColor(QPalette::Text, QColor(225, 225, 225));
  for (const QPalette& palette : {paper_palette(), dark})
    for (int i = 0; i < curve_colors; ++i)
      EXPECT_GE(contrast(curve_color(i, palette), palette.color(QPalette::Base)), 3)
          << "colour " << i;
}

TEST(SpectrumPlot, IsSavedAsPdfPngAndNumbers) {
  SpectrumPlot plot;
  plot.resize(400, 300);
  plot.set_curves(
      {{.name = QStringLiteral("one, \"two\""), .wavelengths = {400, 500.5}, .values = {0.1, 0.25}},
       {.name = QStringLiteral("line"), .wavelengths = {546.1}, .values = {1}}},
      QStringLiteral("reflectance"));
  EXPECT_EQ(plot.csv().toStdString(),
            "curve,nm,value\n\"one, \"\"two\"\"\",400,0.1\n\"one, \"\"two\"\"\",500.5,0.25\n"
            "line,546.1,1\n");
  const QTemporaryDir folder;
  for (const char* name : {"plot.pdf", "plot.png", "plot.csv"}) {
    const QString file = folder.filePath(QString::fromLatin1(name));
    ASSERT_TRUE(plot.save(file)) << name;
    EXPECT_GT(QFile(file).size(), 50) << name;
  }
  EXPECT_EQ(QImage(folder.filePath(QStringLiteral("plot.png"))).size(), QSize(800, 600));
  EXPECT_FALSE(plot.save(folder.filePath(QStringLiteral("plot.svg"))));
  EXPECT_FALSE(plot.save(QStringLiteral("/nowhere/plot.csv")));
}

}  // namespace
}  // namespace metamer::gui
