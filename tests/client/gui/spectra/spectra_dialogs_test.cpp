// Resampling, RGB and metamers in the window are those of the command line.
#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QDir>
#include <QJsonArray>
#include <QSignalSpy>

#include "client/gui/spectra/metamer_dialog.h"
#include "client/gui/spectra/resample_dialog.h"
#include "client/gui/spectra/rgb_dialog.h"
#include "client/gui/spectra/spectra_window.h"
#include "client/tools/scene/checked_scene.h"
#include "tests/client/gui/command_line.h"

namespace metamer::gui {
namespace {

const QString paint = QStringLiteral(METAMER_TEST_DATA "/../deploy/booth/spectra/paint-1.txt");

QList<Listed> listed_words(const QStringList& words) {
  QList<Listed> rows;
  for (const QString& word : words) {
    auto worded = client::worded_spectra(word.toStdString());
    EXPECT_TRUE(worded) << word.toStdString();
    for (auto& one : *worded) rows << *listed(one, Viewer::usual());
  }
  return rows;
}

TEST(ResampleDialog, TextAndEnergyAreThoseOfSpectraResample) {
  for (const QString& word : {QStringLiteral("F11"), QStringLiteral("TCS05"), paint}) {
    SCOPED_TRACE(word.toStdString());
    ResampleDialog dialog(listed_words({word}), Viewer::usual());
    QSignalSpy shown(&dialog, &ResampleDialog::shown);
    dialog.set_uniform(400, 700, 10);
    ASSERT_TRUE(shown.wait(10000));
    QJsonObject said = answer_of({"spectra", "resample", word, "--samples", "400:700:10"});
    EXPECT_EQ(dialog.text(), said["text"].toString());
    const QJsonObject energy = said["spectra"][0].toObject();
    EXPECT_NEAR(dialog.energies().item(0, 1)->text().toDouble(),
                energy["integral_before"].toDouble(), 1e-5 * energy["integral_before"].toDouble());
    EXPECT_NEAR(dialog.energies().item(0, 2)->text().toDouble(),
                energy["integral_after"].toDouble(), 1e-5 * energy["integral_after"].toDouble());

    dialog.set_listed(QStringLiteral("405, 436\n546;612 650"));
    ASSERT_TRUE(shown.wait(10000));
    said = answer_of({"spectra", "resample", word, "--wavelengths", "405,436,546,612,650"});
    EXPECT_EQ(dialog.text(), said["text"].toString());
    EXPECT_EQ(dialog.plot().curves().size(), 2) << "before and after";
  }
}

TEST(ResampleDialog, RefusesWavelengthsThatAreNone) {
  ResampleDialog dialog(listed_words({QStringLiteral("D65")}), Viewer::usual());
  for (const char* wrong : {"", "blue", "500 400", "500 500", "-1", "400 nan"}) {
    dialog.set_listed(QString::fromLatin1(wrong));
    EXPECT_EQ(dialog.text(), QString()) << wrong;
  }
}

TEST(ResampleDialog, SeveralSpectraAreOneTextWithLightsFirst) {
  ResampleDialog dialog(listed_words({QStringLiteral("TCS05"), QStringLiteral("F11")}),
                        Viewer::usual());
  QSignalSpy shown(&dialog, &ResampleDialog::shown);
  dialog.set_uniform(400, 700, 10);
  ASSERT_TRUE(shown.wait(10000));
  EXPECT_EQ(dialog.text(), answer_of({"spectra", "resample", "F11", "TCS05", "--samples",
                                      "400:700:10", "--format", "cgats"})["text"]
                               .toString());
  take_shot(dialog, QStringLiteral("resample"));
}

TEST(RgbDialog, ValuesAreThoseOfSpectraRgb) {
  const QStringList words{QStringLiteral("D65"), QStringLiteral("TCS09"), paint};
  for (const auto& [space, adaptation] :
       {std::pair("srgb", ""), std::pair("prophoto", "bradford"), std::pair("cie-rgb", "sharp")}) {
    SCOPED_TRACE(space);
    RgbDialog dialog(listed_words(words), Viewer::usual());
    const QAbstractItemModelTester tester(&dialog.table(),
                                          QAbstractItemModelTester::FailureReportingMode::Fatal);
    QSignalSpy shown(&dialog, &RgbDialog::shown);
    dialog.set_space(QString::fromLatin1(space));
    dialog.set_adaptation(QString::fromLatin1(adaptation));
    ASSERT_TRUE(shown.wait(10000));
    QStringList asked = QStringList{"spectra", "rgb"} + words + QStringList{"--rgb", space};
    if (*adaptation != '\0') asked << "--adapt" << adaptation;
    const QJsonArray said = answer_of(asked)["spectra"].toArray();
    ASSERT_EQ(dialog.table().rowCount(), said.size());
    for (int row = 0; row < said.size(); ++row) {
      for (int i = 0; i < 3; ++i) {
        const auto number = [&](int column) {
          return dialog.table().index(row, column + i).data(RgbTable::value_role).toDouble();
        };
        EXPECT_EQ(number(RgbTable::xyz), said[row]["xyz"][i].toDouble());
        EXPECT_EQ(number(RgbTable::linear), said[row]["linear"][i].toDouble());
        EXPECT_EQ(number(RgbTable::encoded), said[row]["encoded"][i].toDouble());
      }
      EXPECT_EQ(dialog.table().index(row, RgbTable::gamut).data(RgbTable::value_role).toBool(),
                said[row]["in_gamut"].toBool());
    }
    take_shot(dialog, QStringLiteral("rgb"));
  }
}

TEST(MetamerDialog, ShowsWhatSpectraMetamerFinds) {
  MetamerDialog dialog(nullptr, Viewer::usual());
  QSignalSpy shown(&dialog, &MetamerDialog::shown);
  dialog.make();
  ASSERT_TRUE(shown.wait(60000));
  const QString file = QDir::tempPath() + QStringLiteral("/metamer-gui-test.sp");
  const QJsonArray said = answer_of({"spectra", "metamer", "TCS05", "--under", "D65", "--against",
                                     "A", "-o", file})["differences"]
                              .toArray();
  QFile::remove(file);
  ASSERT_EQ(dialog.table().rowCount(), said.size()) << dialog.told().toStdString();
  for (int row = 0; row < said.size(); ++row) {
    EXPECT_EQ(dialog.table().item(row, 0)->text(), said[row]["light"].toString());
    EXPECT_EQ(dialog.table().item(row, 1)->text(),
              QString::number(said[row]["de00"].toDouble(), 'f', 2));
  }
  ASSERT_EQ(dialog.plot().curves().size(), 2);
  EXPECT_EQ(dialog.plot().curves()[1].wavelengths.size(), 471u) << "360 to 830 nm";
  take_shot(dialog, QStringLiteral("metamer"));
}

TEST(MetamerDialog, SaysWhyThereIsNone) {
  const QList<Listed> light = listed_words({QStringLiteral("D65")});
  MetamerDialog dialog(light.front(), Viewer::usual());
  QSignalSpy shown(&dialog, &MetamerDialog::shown);
  dialog.make();
  ASSERT_TRUE(shown.wait(60000));
  EXPECT_FALSE(dialog.told().isEmpty());
  EXPECT_EQ(dialog.table().rowCount(), 0);
}

TEST(SpectraWindow, ShowsTheSpectraOfTheBooth) {
  SpectraWindow window;
  QSignalSpy added(&window.lists(), &SpectraLists::added);
  client::DigestCache digests;
  const auto checked =
      client::CheckedScene::read(METAMER_TEST_DATA "/../deploy/booth/booth.txtpb", digests);
  window.lists().add_scene(checked.scene(), QStringLiteral(METAMER_TEST_DATA "/../deploy/booth"));
  ASSERT_TRUE(added.wait(10000));
  EXPECT_EQ(window.lists().lights().rowCount(), 1) << "both lamps have D65";
  EXPECT_EQ(window.lists().materials().rowCount(), 19) << "15 colours, 2 paints, 2 greys";
  EXPECT_EQ(window.plot().curves().size(), 20) << "all, as none is chosen";
  take_shot(window, QStringLiteral("spectra-all"));
  window.add_words(QStringLiteral("A F11 2856K"));
  ASSERT_TRUE(added.wait(10000));
  EXPECT_EQ(window.lists().lights().rowCount(), 4);
  EXPECT_EQ(window.chosen().size(), 3) << "what was added is chosen";
  EXPECT_EQ(window.plot().curves().size(), 3);
  take_shot(window, QStringLiteral("spectra"));
  window.remove_chosen();
  EXPECT_EQ(window.lists().lights().rowCount(), 1);
}

}  // namespace
}  // namespace metamer::gui
