// Profiles of colord-data, and a colord that is in this process.
#include "client/gui/picture/display_profile.h"

#include <gtest/gtest.h>

#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusObjectPath>
#include <QDBusServer>
#include <QDBusVariant>
#include <QDBusVirtualObject>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <QtConcurrentRun>

#include "client/gui/picture/xyz_layer.h"

namespace metamer::gui {
namespace {

const QString swapped = QStringLiteral("/usr/share/color/icc/colord/SwappedRedAndGreen.icc");

/// As colord answers, for the output "eDP-1".
class FakeColord : public QDBusVirtualObject {
 public:
  explicit FakeColord(QString file) : file_(std::move(file)) {}
  QString introspect(const QString&) const override { return {}; }
  bool handleMessage(const QDBusMessage& asked, const QDBusConnection& bus) override {
    const auto answer = [&](const QVariant& value) { return bus.send(asked.createReply(value)); };
    const auto property = [&](const QVariant& value) {
      return answer(QVariant::fromValue(QDBusVariant(value)));
    };
    const QVariantList words = asked.arguments();
    if (asked.member() == QStringLiteral("FindDeviceByProperty") &&
        words == QVariantList{QStringLiteral("XRANDR_name"), QStringLiteral("eDP-1")})
      return answer(QVariant::fromValue(QDBusObjectPath(QStringLiteral("/devices/screen"))));
    if (asked.path() == QStringLiteral("/devices/screen") &&
        words.last() == QStringLiteral("Profiles"))
      return property(QVariant::fromValue(
          QList<QDBusObjectPath>{QDBusObjectPath(QStringLiteral("/profiles/own")),
                                 QDBusObjectPath(QStringLiteral("/profiles/other"))}));
    if (asked.path() == QStringLiteral("/profiles/own") &&
        words.last() == QStringLiteral("Filename"))
      return property(file_);
    return bus.send(asked.createErrorReply(QStringLiteral("org.freedesktop.ColorManager.NotFound"),
                                           QStringLiteral("not there")));
  }

 private:
  QString file_;
};

QImage red_square() {
  QImage red(8, 8, QImage::Format_RGB32);
  red.fill(QColor(255, 0, 0));
  return red;
}

QColor seen_on(PictureLayer& layer, const QColorSpace& display) {
  layer.set_viewing({.display = display});
  QImage screen(8, 8, QImage::Format_RGB32);
  QPainter painter(&screen);
  layer.paint(painter, screen.rect(), screen.rect(), 1);
  painter.end();
  return screen.pixelColor(4, 4);
}

TEST(DisplayProfile, RedTurnsGreenOnADisplayWhoseRedAndGreenAreSwapped) {
  const DisplayProfile profile = profile_of_file(swapped);
  EXPECT_EQ(profile.told, QStringLiteral("display: SwappedRedAndGreen.icc"));
  ImageLayer eight(red_square(), {8, 8}, QColorSpace::SRgb);
  auto image = std::make_shared<Image>(make_image(8, 8, {"X", "Y", "Z"}));
  const Matrix3& to_xyz = rgb_space(StandardSpace::srgb).to_xyz;
  for (std::size_t i = 0; i < image->pixels.size(); ++i)
    image->pixels[i] = static_cast<float>(to_xyz[i % 3][0]);
  XyzLayer floats({image});
  for (PictureLayer* layer :
       {static_cast<PictureLayer*>(&eight), static_cast<PictureLayer*>(&floats)}) {
    EXPECT_EQ(seen_on(*layer, QColorSpace::SRgb), QColor(255, 0, 0));
    const QColor turned = seen_on(*layer, profile.space);
    EXPECT_LT(turned.red(), 40);
    EXPECT_GT(turned.green(), 200);
    EXPECT_EQ(layer->image().pixelColor(4, 4), QColor(255, 0, 0)) << "the picture itself stays";
  }
}

TEST(DisplayProfile, OneOfTablesAloneAndOneThatIsNoneAreToldAndShownAsSrgb) {
  QFile swap(swapped);
  ASSERT_TRUE(swap.open(QIODevice::ReadOnly));
  const QByteArray sound = swap.readAll();
  const QTemporaryDir folder;
  for (const QByteArray& bytes :
       {QByteArray(sound).replace("gXYZ", "A2B0"), sound.left(130), QByteArray(), QByteArray("x"),
        QByteArray(sound).replace("acsp", "none"), QByteArray(sound).replace("RGB ", "CMYK")}) {
    QFile file(folder.filePath(QStringLiteral("table.icc")));
    ASSERT_TRUE(file.open(QIODevice::WriteOnly | QIODevice::Truncate));
    file.write(bytes);
    file.close();
    const DisplayProfile profile = profile_of_file(file.fileName());
    EXPECT_EQ(profile.space, QColorSpace(QColorSpace::SRgb));
    EXPECT_EQ(profile.told,
              QStringLiteral("display: table.icc has no matrix (tables are not read), "
                             "sRGB assumed"));
  }
  EXPECT_EQ(profile_of_file(folder.filePath(QStringLiteral("gone.icc"))).told,
            QStringLiteral("display: gone.icc can't be read, sRGB assumed"));
}

TEST(DisplayProfile, IsWhatWasChosenElseWhatColordHasForTheOutputElseSrgb) {
  QDBusServer server;
  ASSERT_TRUE(server.isConnected());
  server.setAnonymousAuthenticationAllowed(true);
  FakeColord colord(swapped);
  std::optional<QDBusConnection> held;
  QObject::connect(&server, &QDBusServer::newConnection, &server, [&](QDBusConnection peer) {
    peer.registerVirtualObject(QStringLiteral("/"), &colord, QDBusConnection::SubPath);
    held = peer;
  });
  const QDBusConnection bus =
      QDBusConnection::connectToPeer(server.address(), QStringLiteral("colord test"));
  ASSERT_TRUE(bus.isConnected()) << bus.lastError().message().toStdString();
  ASSERT_TRUE(QTest::qWaitFor([&] { return held.has_value(); }));
  const auto told = [&](const QString& output, const QString& file) {
    const auto found = QtConcurrent::run([&] { return find_display(bus, {}, output, file).told; });
    EXPECT_TRUE(QTest::qWaitFor([&] { return found.isFinished(); }, 20'000));
    return found.result();
  };
  const QString edp = QStringLiteral("eDP-1");
  EXPECT_EQ(told(edp, {}), QStringLiteral("display: SwappedRedAndGreen.icc"));
  EXPECT_EQ(told(QStringLiteral("HDMI-1"), {}), QStringLiteral("display: sRGB assumed"));
  EXPECT_EQ(told({}, {}), QStringLiteral("display: sRGB assumed"));
  EXPECT_EQ(told(edp, QStringLiteral("/usr/share/color/icc/colord/AdobeRGB1998.icc")),
            QStringLiteral("display: AdobeRGB1998.icc"));
  QDBusConnection::disconnectFromPeer(QStringLiteral("colord test"));
}

TEST(DisplayProfile, SpacesOfPicturesAreThoseOfQt) {
  const QList<std::pair<StandardSpace, QColorSpace>> spaces{
      {StandardSpace::srgb, QColorSpace::SRgb},
      {StandardSpace::display_p3, QColorSpace::DisplayP3},
      {StandardSpace::adobe_rgb, QColorSpace::AdobeRgb},
      {StandardSpace::prophoto, QColorSpace::ProPhotoRgb}};
  for (const auto& [ours, qts] : spaces) {
    const QColorSpace space = color_space({.space = rgb_space(ours)});
    ASSERT_TRUE(space.isValid());
    const auto a = space.transformationToColorSpace(QColorSpace::SRgbLinear),
               b = qts.transformationToColorSpace(QColorSpace::SRgbLinear);
    for (const QColor& color : {QColor(200, 180, 160), QColor(90, 100, 110), QColor(20, 20, 20)}) {
      const QColor one = a.map(color), other = b.map(color);
      EXPECT_NEAR(one.redF(), other.redF(), 2e-3) << qts.description().toStdString();
      EXPECT_NEAR(one.greenF(), other.greenF(), 2e-3);
      EXPECT_NEAR(one.blueF(), other.blueF(), 2e-3);
    }
  }
}

}  // namespace
}  // namespace metamer::gui
