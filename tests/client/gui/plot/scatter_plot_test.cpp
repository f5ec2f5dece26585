#include "client/gui/plot/scatter_plot.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "client/gui/plot/scatter_names.h"

namespace metamer::gui {
namespace {

TEST(AxisScale, IsLogarithmicWhereValuesDifferByTwiceAndMoreAndHoldsAll) {
  for (const QList<double>& values :
       {QList<double>{1, 2}, {1e-4, 1e5}, {2.46, 2.56}, {3}, {3, 3}, {0, 1}, {1, 1.999}}) {
    const AxisScale scale = axis_scale(values, 1e-4);
    const double least = std::max(1e-4, *std::min_element(values.begin(), values.end()));
    const double most = *std::max_element(values.begin(), values.end());
    EXPECT_EQ(scale.logarithmic, most >= 2 * least);
    EXPECT_LT(scale.from, least);
    EXPECT_GT(scale.to, most);
    EXPECT_TRUE(!scale.logarithmic || scale.from > 0);
  }
}

TEST(AxisScale, HasTicksOnEveryLogarithmicAxis) {
  for (double decades = std::log10(2); decades < 12; decades += 0.1)
    for (double from = 1e-4; from < 100; from *= 1.37) {
      const AxisScale scale = axis_scale({from, from * std::pow(10, decades)}, 1e-9);
      const QMap<double, QString> ticks = log_ticks(scale);
      EXPECT_GE(ticks.size(), 2) << from << ", " << decades;
      EXPECT_LE(ticks.size(), 16) << from << ", " << decades;
    }
}

TEST(NamePlaces, NoNameHidesAPointOrAnotherWhereThereIsRoom) {
  QList<QPointF> points;
  for (int i = 0; i < 12; ++i) points << QPointF(40 + 25 * i, 300 - 22 * i);
  NamePlaces places(QRectF(0, 0, 500, 400), points);
  QList<QRectF> names;
  for (const QPointF& point : points)
    names << QRectF(places.place(point, {70, 12}), QSizeF(70, 12));
  for (int i = 0; i < names.size(); ++i) {
    for (int j = 0; j < i; ++j) EXPECT_FALSE(names[i].intersects(names[j])) << i << ' ' << j;
    for (const QPointF& point : points) EXPECT_FALSE(names[i].contains(point));
  }
}

class ScatterPlotTest : public testing::Test {
 protected:
  void SetUp() override {
    plot.resize(600, 300);
    plot.set_axes(QStringLiteral("seconds"), QStringLiteral("error"),
                  {QStringLiteral("a"), QStringLiteral("b")});
    plot.set_points({{.name = QStringLiteral("one"), .x = 1, .y = 10, .whisker = 20, .front = true},
                     {.name = QStringLiteral("two"), .x = 3, .y = 1, .family = 1, .front = true},
                     {.name = QStringLiteral("zero"), .x = 9, .y = 0, .chosen = true}},
                    1e-3);
    plot.set_level(0.1, QStringLiteral("limit"), true);
    plot.show();
    QTest::qWait(1);
    plot.grab();
  }

  QWidget& surface() { return *plot.findChild<QWidget*>(); }
  QPoint inside(const QPoint& at) { return surface().mapFrom(&plot, at); }

  ScatterPlot plot;
};

TEST_F(ScatterPlotTest, AClickOnEachPointSaysWhich) {
  QSignalSpy spy(&plot, &ScatterPlot::clicked);
  for (int i = 0; i < plot.points().size(); ++i) {
    QTest::mouseClick(&surface(), Qt::LeftButton, {}, inside(plot.place_of(i)));
    ASSERT_EQ(spy.size(), i + 1);
    EXPECT_EQ(spy.back().front().toInt(), i);
  }
  QTest::mouseClick(&surface(), Qt::LeftButton, {}, inside(plot.place_of(0)) + QPoint(30, 0));
  QTest::mouseClick(&surface(), Qt::RightButton, {}, inside(plot.place_of(0)));
  EXPECT_EQ(spy.size(), 3);
}

TEST_F(ScatterPlotTest, TheLevelIsDraggedToWhereItIsDroppedWhileTheAxisStays) {
  QSignalSpy dragged(&plot, &ScatterPlot::level_dragged);
  QSignalSpy dropped(&plot, &ScatterPlot::level_dropped);
  const double from = plot.y_scale().from;
  QTest::mousePress(&surface(), Qt::LeftButton, {}, inside(plot.place_of_level()));
  const QPoint there(inside(plot.place_of_level()).x(), inside(plot.place_of(1)).y());
  QTest::mouseMove(&surface(), there);
  EXPECT_EQ(plot.y_scale().from, from);
  QTest::mouseRelease(&surface(), Qt::LeftButton, {}, there);
  EXPECT_GE(dragged.size(), 1);
  ASSERT_EQ(dropped.size(), 1);
  EXPECT_NEAR(dropped[0][0].toDouble(), 1, 0.1) << "at the height of a point whose value is 1";
}

TEST_F(ScatterPlotTest, IsSavedInTheFormatsOfItsEnding) {
  const QTemporaryDir folder;
  for (const char* name : {"plot.pdf", "plot.png", "plot.csv"}) {
    const QString file = folder.filePath(QString::fromUtf8(name));
    EXPECT_TRUE(plot.save(file)) << name;
    EXPECT_TRUE(QFile::exists(file)) << name;
  }
  EXPECT_FALSE(plot.save(folder.filePath(QStringLiteral("plot.gif"))));
  QFile csv(folder.filePath(QStringLiteral("plot.csv")));
  ASSERT_TRUE(csv.open(QIODevice::ReadOnly));
  EXPECT_EQ(csv.readAll(),
            "name,seconds,error,upper,front\none,1,10,20,1\ntwo,3,1,1,1\nzero,9,0,0,0\n");
}

}  // namespace
}  // namespace metamer::gui
