// The dock of methods in a window, with a private metamerd.
#include <gtest/gtest.h>

#include <QAction>
#include <QFile>
#include <QJsonArray>
#include <QJsonObject>
#include <QSignalSpy>
#include <QTest>

#include "../jobs/jobs_window.h"
#include "client/gui/methods/methods_room.h"
#include "common/scene/methods.h"
#include "common/scene/settings.h"
#include "tests/client/gui/command_line.h"

namespace metamer::gui {
namespace {

constexpr const char* small = "width: 32 height: 24 spp: 1";

struct MethodsWindow : test::JobsWindow {
  explicit MethodsWindow(const std::string& settings = small)
      : JobsWindow(test::blink_scene(settings)) {}

  MethodsRoom& room() { return *window().findChild<MethodsRoom*>(); }
  MethodsDock& dock() { return room().dock(); }
  /// Predicts, and waits for it.
  void explain() {
    choose("render.explain");
    ASSERT_TRUE(test::comes([this] { return !dock().rows().isEmpty(); }))
        << dock().note().toStdString();
  }
  v1::Settings settings() {
    return with_defaults(document().effective().value_or(v1::Scene()).settings());
  }
  std::string effective() { return document().effective()->DebugString(); }
  int used() {
    for (int i = 0; i < dock().rows().size(); ++i)
      if (dock().rows()[i].chosen) return i;
    return -1;
  }
  void click(int row) {
    QWidget& plot = *dock().plot().findChild<QWidget*>();
    dock().plot().grab();
    QTest::mouseClick(&plot, Qt::LeftButton, {},
                      plot.mapFrom(&dock().plot(), dock().plot().place_of(row)));
  }
};

TEST(MethodsDock, EveryPredictionIsThereAndTheScenesOwnIsMarked) {
  MethodsWindow test("method { linear { bases: 5 } } width: 32 height: 24 spp: 1");
  test.explain();
  QStringList names;
  for (const MethodRow& row : test.dock().rows()) names << row.name;
  for (const v1::Method& method : candidates())
    EXPECT_TRUE(names.contains(QString::fromStdString(method_text(method)))) << method_text(method);
  EXPECT_EQ(names.size(), static_cast<qsizetype>(candidates().size() + 1)) << "and its own";
  EXPECT_EQ(test.dock().plot().points().size(), names.size());
  ASSERT_GE(test.used(), 0);
  EXPECT_EQ(names[test.used()], QStringLiteral("linear 5"));
  EXPECT_EQ(test.dock().view().model()->rowCount(), names.size());
}

TEST(MethodsDock, EnterOnEachRowSetsItsMethodAndUndoGivesTheSettingsBefore) {
  MethodsWindow test;
  test.explain();
  const std::string own = test.effective();
  QAbstractItemModel& shown = *test.dock().view().model();
  for (int at = 0; at < shown.rowCount(); ++at) {
    test.dock().view().setFocus();
    test.dock().view().setCurrentIndex(shown.index(at, 0));
    const std::string before = test.effective();
    QTest::keyClick(&test.dock().view(), Qt::Key_Return);
    const QString name = shown.index(at, 0).data().toString();
    EXPECT_TRUE(name.endsWith(QString::fromStdString(method_text(test.settings().method()))))
        << name.toStdString();
    EXPECT_TRUE(name.startsWith(QStringLiteral("●"))) << name.toStdString();
    if (test.effective() == before) continue;
    test.document().undo().undo();
    EXPECT_EQ(test.effective(), before);
    test.document().undo().redo();
  }
  while (test.document().undo().canUndo()) test.document().undo().undo();
  EXPECT_EQ(test.effective(), own);
}

TEST(MethodsDock, AClickOnAPointSetsItsMethodForTheLiveViewAndTheSettings) {
  MethodsWindow test;
  test.explain();
  ASSERT_TRUE(test::comes([&] { return test.window().live()->frame() != nullptr; }));
  int row = 0;
  while (!test.dock().rows()[row].method.has_linear()) ++row;
  test.click(row);
  ASSERT_TRUE(test.settings().method().has_linear());
  EXPECT_TRUE(
      test::comes([&] { return test.window().live()->frame()->plan.method().has_linear(); }));
  EXPECT_TRUE(test::comes([&] {
    const auto& came = test.dock().rows()[test.used()].came;
    return came && came->from == QStringLiteral("live") && came->seconds > 0;
  }));
}

TEST(MethodsDock, AToleranceIsAGoalAndWhatIsMarkedIsWhatExplainChooses) {
  MethodsWindow test;
  test.explain();
  for (const double tolerance : {0.5, 5.0, 0.02}) {
    const std::string before = test.effective();
    test.dock().tolerance().setFocus();
    test.dock().tolerance().setValue(tolerance);
    EXPECT_EQ(test.effective(), before) << "it is only shown before Enter";
    QTest::keyClick(&test.dock().tolerance(), Qt::Key_Return);
    ASSERT_TRUE(test.settings().has_goal());
    EXPECT_EQ(test.settings().goal().tolerance(), tolerance);
    ASSERT_TRUE(test::comes([&] { return test.used() >= 0; })) << test.dock().note().toStdString();
    const MethodRow& used = test.dock().rows()[test.used()];
    EXPECT_LE(used.largest(), tolerance) << "under the line";
    EXPECT_FALSE(test.dock().plot().points()[test.used()].faint);

    const QJsonObject answer =
        answer_of({QStringLiteral("explain"), test.path(QStringLiteral("scene.txtpb")),
                   QStringLiteral("--tolerance"), QString::number(tolerance)});
    QString chosen;
    for (const QJsonValue one :
         answer[QStringLiteral("plan")][QStringLiteral("prediction")].toArray())
      if (one[QStringLiteral("chosen")].toBool())
        chosen = one[QStringLiteral("method")].toObject().keys().join(QString());
    EXPECT_TRUE(used.name.startsWith(chosen) && !chosen.isEmpty())
        << used.name.toStdString() << ", " << chosen.toStdString();
    test.document().undo().undo();
    EXPECT_EQ(test.effective(), before);
  }
}

TEST(MethodsDock, TheLineThatIsDraggedIsTheTolerance) {
  MethodsWindow test;
  test.explain();
  test.window().resize(1200, 900);
  ScatterPlot& plot = test.dock().plot();
  plot.grab();
  QWidget& surface = *plot.findChild<QWidget*>();
  const QPoint line = surface.mapFrom(&plot, plot.place_of_level());
  QTest::mousePress(&surface, Qt::LeftButton, {}, line);
  QTest::mouseMove(&surface, line - QPoint(0, 12));
  EXPECT_FALSE(test.settings().has_goal()) << "on its way";
  QTest::mouseRelease(&surface, Qt::LeftButton, {}, line - QPoint(0, 12));
  ASSERT_TRUE(test.settings().has_goal());
  EXPECT_GT(test.settings().goal().tolerance(), 0.5);
  EXPECT_EQ(test.settings().goal().tolerance(), *plot.level());
  EXPECT_EQ(test.document().undo().count(), 1);
}

TEST(MethodsDock, AFinishedJobJoinsItsMethodWithWhatWasMeasuredOfItsError) {
  MethodsWindow test("width: 32 height: 24 spp: 1 verify: true");
  test.explain();
  test.choose("render.render");
  JobPage* page = test.job();
  ASSERT_TRUE(test::comes([page] { return page->picture().has_value(); }));
  ASSERT_TRUE(test::comes([&] {
    const auto& came = test.dock().rows()[test.used()].came;
    return came && came->error.has_value();
  }));
  const CameOf& came = *test.dock().rows()[test.used()].came;
  EXPECT_EQ(came.seconds,
            page->finished()->timing().prepare() + page->finished()->timing().render());
  EXPECT_EQ(came.error->maximum, page->finished()->accuracy().error().maximum());
}

TEST(MethodsDock, SaysThatTheSceneHasChanged) {
  MethodsWindow test;
  test.explain();
  EXPECT_TRUE(test.dock().note().isEmpty());
  test.choose("light.observer.10");
  EXPECT_TRUE(test.dock().note().contains(QStringLiteral("has changed")));
  test.document().undo().undo();
  EXPECT_TRUE(test.dock().note().isEmpty());
}

TEST(MethodsDock, MeasuresEveryMethodAsTheCommandLineDoes) {
  MethodsWindow test("width: 16 height: 12 spp: 1");
  test.choose("render.measure");
  EXPECT_FALSE(test.dock().measure_button().isEnabled());
  ASSERT_TRUE(test::comes([&] { return test.dock().measure_button().isEnabled(); }, 100));
  EXPECT_TRUE(test.dock().note().isEmpty()) << test.dock().note().toStdString();
  const QTemporaryDir folder;
  const QJsonObject answer = answer_of(
      {QStringLiteral("tradeoff"), test.path(QStringLiteral("scene.txtpb")), QStringLiteral("-o"),
       folder.path(), QStringLiteral("--rounds"), QStringLiteral("1")});
  const QJsonArray there = answer[QStringLiteral("rows")].toArray();
  ASSERT_EQ(test.dock().rows().size(), there.size());
  for (const QJsonValue one : there) {
    const QString stem = one[QStringLiteral("method")].toString();
    const double most = one[QStringLiteral("error")][QStringLiteral("maximum")].toDouble();
    EXPECT_TRUE(std::any_of(test.dock().rows().begin(), test.dock().rows().end(),
                            [&](const MethodRow& row) {
                              return row.name.startsWith(stem) &&
                                     std::abs(row.error.maximum - most) <= 1e-9;
                            }))
        << stem.toStdString() << ' ' << most;
  }
  take_shot(test.window(), QStringLiteral("methods_measured"));
  ASSERT_TRUE(test.room().save(folder.filePath(QStringLiteral("mine.csv"))));
  const auto lines_of = [&](const char* name) {
    QFile file(folder.filePath(QString::fromUtf8(name)));
    EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << name;
    return file.readAll().split('\n');
  };
  const auto mine = lines_of("mine.csv"), others = lines_of("tradeoff.csv");
  ASSERT_EQ(mine.size(), others.size());
  EXPECT_EQ(mine[0], others[0]);
  const std::vector<bool> front = front_of(test.dock().rows(), ErrorFigure::maximum);
  double best = 1e300;
  for (int i = 0; i < test.dock().rows().size(); ++i)
    if (front[static_cast<std::size_t>(i)]) {
      EXPECT_LT(test.dock().rows()[i].error.maximum, best);
      best = test.dock().rows()[i].error.maximum;
    }
}

TEST(MethodsDock, ASceneLeavesNothingToTheNextAndFindsItsOwnAgain) {
  MethodsWindow test;
  test.explain();
  const auto rows = test.dock().rows().size();
  test.choose("file.new");
  EXPECT_TRUE(test.dock().rows().isEmpty());
  EXPECT_FALSE(test.room().save(test.path(QStringLiteral("none.csv"))));
  test.window().scenes().setCurrentIndex(0);
  EXPECT_EQ(test.dock().rows().size(), rows);
  test.choose("file.close");
  EXPECT_TRUE(test.dock().rows().isEmpty());
}

TEST(MethodsDock, CancelEndsTheMeasurementAndThePredictionsStay) {
  MethodsWindow test;
  test.explain();
  const auto before = test.dock().rows().size();
  test.choose("render.measure");
  ASSERT_TRUE(test::comes([&] { return test.dock().cancel_button().isVisible(); }));
  test.dock().cancel_button().click();
  ASSERT_TRUE(test::comes([&] { return test.dock().measure_button().isEnabled(); }));
  EXPECT_TRUE(test.dock().note().contains(QStringLiteral("cancelled")))
      << test.dock().note().toStdString();
  EXPECT_EQ(test.dock().rows().size(), before);
}

}  // namespace
}  // namespace metamer::gui
