// Two pictures in the window are as far apart as `metamer compare` says.
#include "client/gui/compare/compare_page.h"

#include <gtest/gtest.h>

#include <QDropEvent>
#include <QFile>
#include <QJsonArray>
#include <QMimeData>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QUrl>
#include <cmath>

#include "client/gui/app/main_window.h"
#include "common/image/spectral_exr.h"
#include "tests/client/gui/command_line.h"

namespace metamer::gui {
namespace {

/// Grey from left to right, with one pixel of its own.
Image ramp_with_spot(int width, int height, float red) {
  Image image = make_image(width, height, {"X", "Y", "Z"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float grey = 0.1F + 0.8F * static_cast<float>(x) / static_cast<float>(width);
      float* pixel = image.at(x, y);
      pixel[0] = 0.95F * grey;
      pixel[1] = grey;
      pixel[2] = 1.09F * grey;
    }
  image.at(width / 3, height / 2)[0] += red;
  return image;
}

/// Bands of a reflectance that falls or rises.
Result<void> write_reflectance(const QString& file, float slope) {
  SpectralImage image;
  image.width = 3;
  image.height = 2;
  image.reflectance = true;
  for (int nm = 400; nm <= 700; nm += 20) image.nm.push_back(nm);
  for (int pixel = 0; pixel < 6; ++pixel)
    for (std::size_t band = 0; band < image.nm.size(); ++band)
      image.values.push_back(0.4F + slope * static_cast<float>(pixel) *
                                        (static_cast<float>(band) / 15 - 0.5F));
  return write_spectral_exr(image, make_image(3, 2, {"X", "Y", "Z"}), file.toStdString(), {});
}

class ComparePictures : public ::testing::Test {
 protected:
  ComparePictures() {
    EXPECT_TRUE(write_image(ramp_with_spot(24, 16, 0), path("a.png").toStdString(), false, {}));
    EXPECT_TRUE(write_image(ramp_with_spot(24, 16, 0.2F), path("b.png").toStdString(), false, {}));
    EXPECT_TRUE(write_image(ramp_with_spot(24, 16, 0.01F), path("c.exr").toStdString(), true, {}));
    EXPECT_TRUE(write_image(ramp_with_spot(8, 16, 0), path("small.png").toStdString(), false, {}));
    EXPECT_TRUE(write_reflectance(path("s.exr"), 0.05F));
    EXPECT_TRUE(write_reflectance(path("t.exr"), -0.05F));
  }
  QString path(const char* name) const { return folder_.filePath(QString::fromLatin1(name)); }
  /// Waits for what the page makes of a change.
  template <class Change>
  void change(Change&& change) {
    QSignalSpy shown(&page_, &ComparePage::shown);
    change();
    ASSERT_TRUE(shown.wait(20000));
  }
  void show(const char* a, const char* b) {
    page_.slot_box(0).set_source({path(a)});
    change([&] { page_.slot_box(1).set_source({path(b)}); });
  }

  QTemporaryDir folder_;
  ComparePage page_{[] { return QList<PictureAtHand>(); }};
};

void expect_same(const ErrorStatistics& found, int width, const QJsonObject& said) {
  EXPECT_EQ(found.mean, said["mean"].toDouble());
  EXPECT_EQ(found.median, said["median"].toDouble());
  EXPECT_EQ(found.percentile_95, said["percentile_95"].toDouble());
  EXPECT_EQ(found.percentile_99, said["percentile_99"].toDouble());
  EXPECT_EQ(found.maximum, said["maximum"].toDouble());
  const client::Pixel at = client::pixel_at(found.at, width);
  EXPECT_EQ(static_cast<int>(at.x), said["at"]["x"].toInt());
  EXPECT_EQ(static_cast<int>(at.y), said["at"]["y"].toInt());
}

TEST_F(ComparePictures, NumbersAreThoseOfCompare) {
  for (const auto& [a, b] :
       {std::pair("a.png", "b.png"), std::pair("a.png", "c.exr"), std::pair("s.exr", "t.exr")}) {
    show(a, b);
    for (const auto& [metric, word] :
         {std::pair(Metric::deuv, "deuv"), {Metric::deab, "deab"}, {Metric::de00, "de00"}}) {
      SCOPED_TRACE(std::string(a) + " " + b + " " + word);
      change([&, metric = metric] { page_.set_metric(metric); });
      QStringList words{"compare", path(a), path(b), "--metric", word};
      if (*a == 's')
        words << "--under"
              << "D65";
      const QJsonObject said = answer_of(words);
      ASSERT_TRUE(page_.comparison()) << page_.told().toStdString();
      expect_same(page_.comparison()->difference.statistics, page_.comparison()->map.width(),
                  said["difference"].toObject());
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(page_.comparison()->white.xyz[static_cast<std::size_t>(i)],
                  said["white"]["xyz"][i].toDouble());
    }
  }
}

TEST_F(ComparePictures, SavedMapIsThatOfCompare) {
  show("a.png", "b.png");
  ASSERT_TRUE(page_.comparison());
  const auto saved = save_map(*page_.comparison(), Metric::de00, path("map.png"));
  ASSERT_TRUE(saved) << saved.error().message;
  answer_of({"compare", path("a.png"), path("b.png"), "-o", path("said.png")});
  QFile own(path("map.png")), said(path("said.png"));
  ASSERT_TRUE(own.open(QIODevice::ReadOnly) && said.open(QIODevice::ReadOnly));
  EXPECT_EQ(own.readAll(), said.readAll());
  // The pixels of the map on the screen are those of the file, within what rounding does.
  const QImage file(path("map.png")), screen = page_.comparison()->map;
  const int left = (file.width() - screen.width()) / 2;
  for (int y = 0; y < screen.height(); ++y)
    for (int x = 0; x < screen.width(); ++x) {
      const QColor one = screen.pixelColor(x, y), other = file.pixelColor(left + x, y);
      EXPECT_LE(std::abs(one.red() - other.red()), 1);
      EXPECT_LE(std::abs(one.green() - other.green()), 1);
      EXPECT_LE(std::abs(one.blue() - other.blue()), 1);
    }
}

TEST_F(ComparePictures, VerdictIsAWordAndAMark) {
  show("a.png", "b.png");
  const double most = page_.comparison()->difference.statistics.maximum;
  EXPECT_TRUE(page_.verdict().isEmpty()) << "no limit, no verdict";
  page_.set_limit(std::ceil(most));
  EXPECT_TRUE(page_.verdict().startsWith(QStringLiteral("✓ pass")));
  page_.set_limit(most / 2);
  EXPECT_TRUE(page_.verdict().startsWith(QStringLiteral("✗ fail")));
  EXPECT_TRUE(page_.verdict().contains(QStringLiteral("1 "))) << page_.verdict().toStdString();
}

TEST_F(ComparePictures, OtherSizesAndFilesThatAreNoneAreSaid) {
  show("a.png", "small.png");
  EXPECT_FALSE(page_.comparison());
  EXPECT_TRUE(page_.told().contains(QStringLiteral("24"))) << page_.told().toStdString();
  show("a.png", "nothing.png");
  EXPECT_FALSE(page_.comparison());
  EXPECT_TRUE(page_.told().contains(QStringLiteral("nothing.png")));
  show("a.png", "b.png");
  EXPECT_TRUE(page_.comparison()) << "and it goes on";
}

TEST_F(ComparePictures, BothCanvasesShowTheSamePlace) {
  page_.resize(1100, 760);
  page_.show();
  show("a.png", "b.png");
  page_.set_limit(2);
  take_shot(page_, QStringLiteral("compare"));
  page_.canvas().one_to_one();
  EXPECT_FALSE(page_.map().fitted());
  page_.map().zoom(4, QPointF(20, 20));
  EXPECT_EQ(page_.canvas().view().zoom, page_.map().view().zoom);
  EXPECT_EQ(page_.canvas().view().centre, page_.map().view().centre);
  page_.canvas().shift({5, -3});
  EXPECT_EQ(page_.canvas().view().centre, page_.map().view().centre);
  page_.go_to_maximum();
  const QPointF middle = page_.canvas().rect().center();
  EXPECT_EQ(page_.canvas().pixel_at(middle), QPoint(24 / 3, 16 / 2)) << "the one that differs";
  page_.canvas().fit();
  EXPECT_TRUE(page_.map().fitted());
}

TEST_F(ComparePictures, WipeShowsBRightOfItsDivider) {
  page_.resize(1100, 760);
  page_.show();
  show("a.png", "b.png");
  ASSERT_EQ(page_.side(), ComparePage::Side::wipe);
  Canvas& canvas = page_.canvas();
  canvas.set_divider(1);
  const QImage a = canvas.grab().toImage();
  canvas.set_divider(0);
  const QImage b = canvas.grab().toImage();
  const QPoint spot = ((canvas.place_of({8, 8}) + canvas.place_of({9, 9})) / 2).toPoint();
  EXPECT_NE(a.pixelColor(spot), b.pixelColor(spot));
  // Dragged from the left edge to the middle, which lies right of the spot.
  const QPoint edge(1, 20), middle(canvas.width() / 2, 20);
  QTest::mousePress(&canvas, Qt::LeftButton, {}, edge);
  QTest::mouseMove(&canvas, middle);
  QTest::mouseRelease(&canvas, Qt::LeftButton, {}, middle);
  EXPECT_NEAR(canvas.divider(), 0.5, 0.02);
  EXPECT_EQ(canvas.grab().toImage().pixelColor(spot), a.pixelColor(spot)) << "left of it";
  page_.show_side(ComparePage::Side::b);
  EXPECT_EQ(canvas.grab().toImage().pixelColor(spot), b.pixelColor(spot));
}

TEST_F(ComparePictures, AFileOfSeveralPicturesAsksWhichIsMeant) {
  const QString file = QStringLiteral(METAMER_TEST_DATA "/common/image/cases/multipart.exr");
  page_.slot_box(0).set_source({file});
  change([&] { page_.slot_box(1).set_source({file}); });
  auto* layers = page_.slot_box(1).findChild<QComboBox*>();
  ASSERT_TRUE(QTest::qWaitFor([&] { return layers->count() == 2; }, 10000));
  ASSERT_TRUE(page_.comparison()) << page_.told().toStdString();
  EXPECT_EQ(page_.comparison()->difference.statistics.maximum, 0);
  change([&] {
    layers->setCurrentIndex(1);
    Q_EMIT layers->activated(1);
  });
  EXPECT_TRUE(page_.slot_box(1).source()->choice.part.has_value());
}

TEST_F(ComparePictures, DroppedFilesFillTheSlots) {
  for (const char* name : {"a.png", "b.png"}) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path(name))});
    QDragEnterEvent enter({5, 5}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&page_, &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent drop({5, 5}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&page_, &drop);
  }
  ASSERT_TRUE(page_.slot_box(0).source() && page_.slot_box(1).source());
  EXPECT_EQ(page_.slot_box(0).source()->file, path("a.png"));
  EXPECT_EQ(page_.slot_box(1).source()->file, path("b.png"));
  EXPECT_TRUE(QTest::qWaitFor([&] { return page_.comparison() != nullptr; }, 10000));
}

TEST_F(ComparePictures, TheWindowOpensThePageAndWWipes) {
  Link link;
  MainWindow window(link);
  window.show();
  window.actions()[QStringLiteral("compare.pictures")]->trigger();
  auto* page = window.findChild<ComparePage*>();
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(window.pictures().currentWidget(), page);
  page->add({path("a.png")});
  page->add({path("b.png")});
  ASSERT_TRUE(QTest::qWaitFor([&] { return page->comparison() != nullptr; }, 20000));
  const QAction& wipe = *window.actions()[QStringLiteral("view.wipe")];
  EXPECT_EQ(page->side(), ComparePage::Side::wipe);
  EXPECT_TRUE(wipe.isChecked());
  page->canvas().setFocus();
  QTest::keyClick(&page->canvas(), Qt::Key_W);
  EXPECT_EQ(page->side(), ComparePage::Side::a);
  QTest::keyClick(&page->canvas(), Qt::Key_W);
  EXPECT_EQ(page->side(), ComparePage::Side::wipe);
  page->show_side(ComparePage::Side::b);
  EXPECT_FALSE(wipe.isChecked());
  window.actions()[QStringLiteral("compare.pictures")]->trigger();
  EXPECT_EQ(window.findChildren<ComparePage*>().size(), 1) << "the same page again";
}

}  // namespace
}  // namespace metamer::gui
