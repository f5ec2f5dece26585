// The lists of the spectra manager, against what the command line says of the same spectra.
#include "client/gui/spectra/spectra_table.h"

#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QJsonArray>
#include <QMimeData>
#include <QSignalSpy>
#include <QSortFilterProxyModel>

#include "client/gui/spectra/spectra_lists.h"
#include "tests/client/gui/command_line.h"

namespace metamer::gui {
namespace {

using Kind = SpectraTable::Kind;

const QString paint_file = QStringLiteral(METAMER_TEST_DATA "/../deploy/booth/spectra/paint-1.txt");

Listed listed_word(const QString& word, const Viewer& viewer = Viewer::usual()) {
  auto worded = client::worded_spectra(word.toStdString());
  EXPECT_TRUE(worded) << word.toStdString();
  const auto row = listed(worded->front(), viewer);
  EXPECT_TRUE(row) << word.toStdString();
  return *row;
}

double number_at(const SpectraTable& table, int row, int column) {
  return table.data(table.index(row, column), SpectraTable::value_role).toDouble();
}

TEST(SpectraTable, PassesTheTesterWhileRowsComeChangeAndGo) {
  for (const Kind kind : {Kind::lights, Kind::materials}) {
    SpectraTable table(kind);
    const QAbstractItemModelTester tester(&table,
                                          QAbstractItemModelTester::FailureReportingMode::Fatal);
    QSortFilterProxyModel sorted;
    sorted.setSourceModel(&table);
    sorted.setSortRole(SpectraTable::value_role);
    const QAbstractItemModelTester sorted_tester(
        &sorted, QAbstractItemModelTester::FailureReportingMode::Fatal);
    const QStringList words = kind == Kind::lights
                                  ? QStringList{"D65", "A", "F11", "2856K", "436nm+546nm"}
                                  : QStringList{"TCS01", "TCS09", "TCS14"};
    for (const QString& word : words) table.add(listed_word(word));
    EXPECT_EQ(table.rowCount(), words.size());
    sorted.sort(SpectraTable::luminance, Qt::DescendingOrder);
    const auto luminance = [&](int row) {
      return sorted.index(row, SpectraTable::luminance).data(SpectraTable::value_role).toDouble();
    };
    for (int row = 1; row < sorted.rowCount(); ++row) EXPECT_GE(luminance(row - 1), luminance(row));
    table.add(table.rows().front());
    EXPECT_EQ(table.rowCount(), words.size()) << "each word once";
    table.replace(table.rows());
    EXPECT_TRUE(table.removeRows(1, 2));
    EXPECT_FALSE(table.removeRows(table.rowCount(), 1));
    EXPECT_EQ(table.rowCount(), words.size() - 2);
  }
}

TEST(SpectraTable, SaysOfLightsWhatSpectraInfoSays) {
  for (const QString& word :
       {QStringLiteral("D65"), QStringLiteral("F11"), QStringLiteral("2856K")})
    for (const QString& observer :
         {QStringLiteral("cie-1931-2deg"), QStringLiteral("cie-1964-10deg")}) {
      SCOPED_TRACE(word.toStdString() + " to " + observer.toStdString());
      const auto viewer = Viewer::of(observer, QStringLiteral("D65"));
      ASSERT_TRUE(viewer);
      SpectraTable table(Kind::lights);
      table.set_viewer(*viewer);
      table.add(listed_word(word, *viewer));
      const QJsonObject said = answer_of({"spectra", "info", word})["spectra"][0].toObject();
      const QJsonObject seen = said[observer].toObject();
      EXPECT_EQ(table.data(table.index(0, SpectraTable::kind), Qt::DisplayRole).toString(),
                said["kind"].toString());
      EXPECT_EQ(number_at(table, 0, SpectraTable::range), said["from"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::samples), said["samples"].toInt());
      EXPECT_EQ(number_at(table, 0, SpectraTable::least), said["min"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::most), said["max"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::luminance), seen["luminance"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::x), seen["x"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::y), seen["y"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::temperature),
                said["color_temperature"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::rendering), said["rendering"]["ra"].toDouble());
    }
}

TEST(SpectraTable, SaysOfMaterialsWhatSpectraInfoSays) {
  for (const QString& word : {QStringLiteral("TCS09"), QStringLiteral("TCS14"), paint_file})
    for (const QString& light : {QStringLiteral("D65"), QStringLiteral("F11")}) {
      SCOPED_TRACE(word.toStdString() + " under " + light.toStdString());
      const auto viewer = Viewer::of(QStringLiteral("cie-1964-10deg"), light);
      ASSERT_TRUE(viewer);
      SpectraTable table(Kind::materials);
      table.set_viewer(*viewer);
      table.add(listed_word(word, *viewer));
      const QJsonObject said = answer_of({"spectra", "info", word, "--under", light, "--observer",
                                          "cie-1964-10deg"})["spectra"][0]
                                   .toObject();
      EXPECT_EQ(number_at(table, 0, SpectraTable::luminance), said["luminance"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::x), said["x"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::y), said["y"].toDouble());
      EXPECT_EQ(number_at(table, 0, SpectraTable::samples), said["samples"].toInt());
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(number_at(table, 0, SpectraTable::lights_only + i), said["lab"][i].toDouble());
    }
}

TEST(SpectraTable, LuminanceOfALightIsWhatIsTyped) {
  SpectraTable table(Kind::lights);
  const QAbstractItemModelTester tester(&table,
                                        QAbstractItemModelTester::FailureReportingMode::Fatal);
  QSignalSpy refused(&table, &SpectraTable::refused);
  table.add(listed_word(QStringLiteral("D65")));
  const QModelIndex cell = table.index(0, SpectraTable::luminance);
  const double x = number_at(table, 0, SpectraTable::x);
  EXPECT_TRUE(table.setData(cell, QStringLiteral("0.72"), Qt::EditRole));
  EXPECT_NEAR(number_at(table, 0, SpectraTable::luminance), 0.72, 1e-14);
  EXPECT_NEAR(number_at(table, 0, SpectraTable::x), x, 1e-14);
  for (const char* wrong : {"0", "-1", "nan", "inf", "bright", ""})
    EXPECT_FALSE(table.setData(cell, QString::fromLatin1(wrong), Qt::EditRole)) << wrong;
  EXPECT_EQ(refused.count(), 6);
  EXPECT_NEAR(number_at(table, 0, SpectraTable::luminance), 0.72, 1e-14);

  SpectraTable materials(Kind::materials);
  materials.add(listed_word(QStringLiteral("TCS01")));
  EXPECT_FALSE(materials.setData(materials.index(0, SpectraTable::luminance), 0.5, Qt::EditRole));
}

TEST(SpectraTable, RowsAreDraggedAsTheirWords) {
  SpectraTable table(Kind::materials);
  table.add(listed_word(QStringLiteral("TCS09")));
  table.add(listed_word(paint_file));
  QModelIndexList all;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < table.columnCount(); ++column) all << table.index(row, column);
  const std::unique_ptr<QMimeData> data(table.mimeData(all));
  EXPECT_EQ(data->text(), QStringLiteral("TCS09\n") + paint_file);
  EXPECT_TRUE(table.flags(all.front()).testFlag(Qt::ItemIsDragEnabled));
}

TEST(SpectraLists, AnotherViewerChangesAllRowsOrIsRefused) {
  SpectraLists lists;
  QSignalSpy added(&lists, &SpectraLists::added), changed(&lists, &SpectraLists::viewer_changed),
      refused(&lists, &SpectraLists::refused);
  lists.add({QStringLiteral("TCS09"), QStringLiteral("nonsense"), QStringLiteral("D65")});
  ASSERT_TRUE(added.wait(10000));
  EXPECT_EQ(lists.lights().rowCount(), 1);
  EXPECT_EQ(lists.materials().rowCount(), 1);
  EXPECT_EQ(refused.count(), 1);
  const double before = number_at(lists.materials(), 0, SpectraTable::luminance);
  lists.set_viewer(QStringLiteral("cie-1931-2deg"), QStringLiteral("A"));
  ASSERT_TRUE(changed.wait(10000));
  EXPECT_GT(number_at(lists.materials(), 0, SpectraTable::luminance), 1.2 * before) << "red";
  lists.set_viewer(QStringLiteral("cie-1931-2deg"), QStringLiteral("TCS01"));
  ASSERT_TRUE(refused.wait(10000));
  EXPECT_EQ(lists.viewer().light_word, QStringLiteral("A"));
}

}  // namespace
}  // namespace metamer::gui
