#include "client/gui/inspector/inspector.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QItemSelectionModel>
#include <QLabel>
#include <QPushButton>

#include "client/gui/inspector/spot_finder.h"
#include "common/color/srgb.h"
#include "common/scene/probed.h"
#include "tests/client/gui/command_line.h"
#include "tests/client/gui/jobs/jobs_window.h"

namespace metamer::gui {
namespace {

Spot spot_of(const Xyz& xyz, const QString& from = QStringLiteral("a")) {
  Spot spot;
  spot.from = from;
  spot.pixel = {3, 4};
  spot.color = client::read_color(xyz, Xyz{0.9505, 1, 1.089}, {});
  return spot;
}

TEST(PinTable, KeepsToTheLawsOfModels) {
  PinTable table;
  const QAbstractItemModelTester tester(&table,
                                        QAbstractItemModelTester::FailureReportingMode::Fatal);
  for (int i = 0; i < 5; ++i) table.add(spot_of({0.2, 0.2, 0.2}));
  table.remove({table.index(1, 0), table.index(3, 0), table.index(3, 2)});
  ASSERT_EQ(table.rowCount(), 3);
  EXPECT_EQ(table.pins()[1].number, 3);
  table.add({});
  EXPECT_EQ(table.pins().back().number, 6) << "numbers are not given again";
  for (int c = 0; c < table.columnCount(); ++c)
    EXPECT_FALSE(table.headerData(c, Qt::Horizontal, Qt::DisplayRole).toString().isEmpty());
}

TEST(Inspector, SaysDeltaEOfTwoPinsThatAreSelected) {
  Inspector inspector;
  // Sharma's first pair of CIEDE2000: 2.0425.
  const Lab pair[] = {{50, 2.6772, -79.7751}, {50, 0, -82.7485}};
  for (const Lab& lab : pair) {
    Spot spot = spot_of({0.2, 0.2, 0.2});
    spot.color->lab = lab;
    inspector.show_spot(spot);
    ASSERT_TRUE(inspector.pin());
  }
  inspector.table().selectAll();
  bool said = false;
  for (const QLabel* label : inspector.findChildren<QLabel*>())
    said = said || label->text().contains(QStringLiteral("2.04"));
  EXPECT_TRUE(said);
}

TEST(Inspector, PinsNothingThatHasNoColour) {
  Inspector inspector;
  EXPECT_FALSE(inspector.pin());
  inspector.show_spot(Spot{});
  EXPECT_FALSE(inspector.pin());
  EXPECT_TRUE(inspector.pins().pins().isEmpty());
}

TEST(Pins, AreALineEachInATable) {
  Pin plain{.number = 1, .spot = spot_of({0.2, 0.3, 0.4}, QStringLiteral("a, \"b\""))};
  const QByteArray short_text = to_csv({plain});
  EXPECT_EQ(short_text.count("\r\n"), 2);
  EXPECT_TRUE(short_text.contains("\"a, \"\"b\"\"\""));
  EXPECT_TRUE(short_text.contains(",0.2,0.3,0.4,"));
  plain.spot.from = QStringLiteral("a");
  Pin probed = plain;
  probed.spot.probed.set_object("ball");
  for (auto* values : {probed.spot.probed.mutable_eye(), probed.spot.probed.mutable_light(),
                       probed.spot.probed.mutable_surface()})
    values->Resize(probed_values, 0.5);
  const QList<QByteArray> lines = to_csv({plain, probed}).split('\n');
  ASSERT_EQ(lines.size(), 4);
  EXPECT_TRUE(lines[0].contains("surface 830 nm"));
  EXPECT_EQ(lines[2].count(','), lines[0].count(','));
  EXPECT_EQ(lines[0].count(','), 17 + 3 * probed_values);
}

/// The window's inspector in a live view, where it is asked for.
class LiveInspector : public testing::Test {
 protected:
  Inspector& inspector() { return *test.window().findChild<Inspector*>(); }
  bool hover(const QPoint& pixel) {
    Q_EMIT test.window().live()->canvas().hovered(pixel);
    return metamer::test::comes(
        [&] { return inspector().spot() && !inspector().spot()->probed.object().empty(); });
  }
  bool complete() {
    return metamer::test::comes([&] {
      const auto frame = test.window().live()->frame();
      return frame && frame->frame.complete();
    });
  }

  metamer::test::JobsWindow test{metamer::test::blink_scene("width: 64 height: 48 spp: 1")};
};

TEST_F(LiveInspector, SaysWhatIsUnderTheCursorAndGoesToItsLine) {
  ASSERT_TRUE(complete());
  const QSize size = test.window().live()->canvas().image().size();
  ASSERT_TRUE(hover({size.width() / 2, size.height() / 2}));
  const Spot& spot = *inspector().spot();
  EXPECT_EQ(spot.probed.object(), "ball");
  EXPECT_EQ(spot.probed.material(), "ball");
  ASSERT_TRUE(spot.color);
  // As the canvas shows it, which is the mean of this pixel alone.
  const QColor shown =
      test.window().live()->canvas().image().pixelColor(size.width() / 2, size.height() / 2);
  EXPECT_NEAR(255 * spot.color->encoded[0], shown.red(), 1);
  EXPECT_NEAR(255 * spot.color->encoded[2], shown.blue(), 1);
  Q_EMIT inspector().object_clicked(QStringLiteral("ball"));
  const QStringList lines = test.window().editor()->text().split(QLatin1Char('\n'));
  EXPECT_TRUE(lines[test.window().editor()->line() - 1].startsWith(
      QStringLiteral("object { name: \"ball\"")));
}

TEST_F(LiveInspector, PinsStayWhenTheCursorGoesOn) {
  ASSERT_TRUE(complete());
  const QSize size = test.window().live()->canvas().image().size();
  ASSERT_TRUE(hover({size.width() / 2, size.height() / 2}));
  test.choose("light.pin");
  ASSERT_EQ(inspector().pins().pins().size(), 1);
  take_shot(test.window(), QStringLiteral("inspector"));
  EXPECT_EQ(inspector().pins().pins()[0].spot.probed.eye_size(), probed_values);
}

TEST_F(LiveInspector, OfAFinishedPictureColourAndLightComeFromItself) {
  test.choose("render.render");
  JobPage* page = test.job();
  ASSERT_TRUE(metamer::test::comes([page] { return page->picture().has_value(); }));
  Q_EMIT page->canvas().hovered(QPoint(32, 24));
  ASSERT_TRUE(metamer::test::comes([&] {
    return inspector().spot() && inspector().spot()->probed.eye_size() == probed_values;
  }));
  const client::PixelReading& color = *inspector().spot()->color;
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_FLOAT_EQ(static_cast<float>(color.xyz[c]), page->picture()->xyz->at(32, 24)[c]);
  // What reaches the eye has that colour.
  Spectrum eye;
  for (int i = 0; i < probed_values; ++i) {
    eye.nm.push_back(probed_first_nm + i);
    eye.values.push_back(inspector().spot()->probed.eye(i));
  }
  const Xyz seen = emission_xyz(eye, cie::observer_1931());
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], color.xyz[c], 2e-3 * color.xyz[1]);
  // The same is met there as in the live view.
  EXPECT_EQ(inspector().spot()->probed.material(), "ball");
  EXPECT_EQ(inspector().spot()->probed.object(), "ball");
  Q_EMIT inspector().object_clicked(QStringLiteral("ball"));
  const QStringList lines = test.window().editor()->text().split(QLatin1Char('\n'));
  EXPECT_TRUE(lines[test.window().editor()->line() - 1].startsWith(
      QStringLiteral("object { name: \"ball\"")));
}

TEST_F(LiveInspector, OfAFinishedPictureWithoutFactorsXyzAloneAreKnownAndItSaysSo) {
  test.choose("render.render");
  JobPage* page = test.job();
  ASSERT_TRUE(metamer::test::comes([page] { return page->picture().has_value(); }));
  Picture bare = *page->picture();
  bare.factors = nullptr;
  page->show_relit(bare, {});
  inspector().findChild<QSpinBox*>()->setValue(5);
  Q_EMIT page->canvas().hovered(QPoint(32, 24));
  ASSERT_TRUE(inspector().spot() && inspector().spot()->color && inspector().spot()->spread);
  EXPECT_GE((*inspector().spot()->spread)[1], 0);
  EXPECT_EQ(inspector().spot()->probed.material(), "");
  bool said = false;
  for (const QLabel* label : inspector().findChildren<QLabel*>())
    said = said || (!label->isHidden() && label->text().contains(QStringLiteral("X Y Z alone")));
  EXPECT_TRUE(said);
}

}  // namespace
}  // namespace metamer::gui
