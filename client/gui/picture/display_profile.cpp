#include "client/gui/picture/display_profile.h"

#include <QCoreApplication>
#include <QDBusConnection>
#include <QDBusMessage>
#include <QDBusObjectPath>
#include <QDBusReply>
#include <QFile>
#include <QFileInfo>
#include <QtEndian>

namespace metamer::gui {
namespace {

QString display_words(const char* text) { return QCoreApplication::translate("Display", text); }

constexpr qint64 most_profile_bytes = qint64{16}
                                      << 20;  // of a profile: tables of printers have 4 MB
constexpr int colord_patience = 3000;         // ms

/// Whether an ICC profile has a matrix and curves (ICC.1:2022, 7.2 and 7.3): tables alone are not
/// read.
bool has_matrix(const QByteArray& profile) {
  constexpr qsizetype header = 128, entry = 12;
  if (profile.size() < header + 4 || profile.mid(36, 4) != "acsp") return false;
  const qsizetype tags = qFromBigEndian<quint32>(profile.constData() + header);
  QByteArrayList found;
  for (qsizetype i = 0; i < tags && header + 4 + (i + 1) * entry <= profile.size(); ++i)
    found << profile.mid(header + 4 + i * entry, 4);
  for (const char* needed : {"rXYZ", "gXYZ", "bXYZ", "rTRC", "gTRC", "bTRC"})
    if (!found.contains(needed)) return false;
  return profile.mid(16, 4) == "RGB ";
}

QVariant property_of(const QDBusConnection& bus, const QString& service, const QString& path,
                     const char* interface, const char* name) {
  QDBusMessage ask = QDBusMessage::createMethodCall(
      service, path, QStringLiteral("org.freedesktop.DBus.Properties"), QStringLiteral("Get"));
  ask << QString::fromLatin1(interface) << QString::fromLatin1(name);
  const QDBusReply<QDBusVariant> reply = bus.call(ask, QDBus::Block, colord_patience);
  return reply.isValid() ? reply.value().variant() : QVariant();
}

}  // namespace

DisplayProfile profile_of_file(const QString& file) {
  const QString name = QFileInfo(file).fileName();
  DisplayProfile profile;
  QFile there(file);
  if (!there.open(QIODevice::ReadOnly) || there.size() > most_profile_bytes) {
    profile.told = display_words("display: %1 can't be read, sRGB assumed").arg(name);
    return profile;
  }
  const QByteArray bytes = there.readAll();
  const QColorSpace space = has_matrix(bytes) ? QColorSpace::fromIccProfile(bytes) : QColorSpace();
  if (!space.isValid()) {
    profile.told =
        display_words("display: %1 has no matrix (tables are not read), sRGB assumed").arg(name);
    return profile;
  }
  profile.space = space;
  profile.told = display_words("display: %1").arg(name);
  return profile;
}

QString colord_profile(const QDBusConnection& bus, const QString& service, const QString& output) {
  if (output.isEmpty() || !bus.isConnected()) return {};
  QDBusMessage find = QDBusMessage::createMethodCall(
      service, QStringLiteral("/org/freedesktop/ColorManager"),
      QStringLiteral("org.freedesktop.ColorManager"), QStringLiteral("FindDeviceByProperty"));
  find << QStringLiteral("XRANDR_name") << output;
  const QDBusReply<QDBusObjectPath> device = bus.call(find, QDBus::Block, colord_patience);
  if (!device.isValid()) return {};
  // The first one is the default.
  const auto profiles = qdbus_cast<QList<QDBusObjectPath>>(property_of(
      bus, service, device.value().path(), "org.freedesktop.ColorManager.Device", "Profiles"));
  if (profiles.isEmpty()) return {};
  return property_of(bus, service, profiles.first().path(), "org.freedesktop.ColorManager.Profile",
                     "Filename")
      .toString();
}

DisplayProfile find_display(const QDBusConnection& bus, const QString& service,
                            const QString& output, const QString& file) {
  const QString found = file.isEmpty() ? colord_profile(bus, service, output) : file;
  if (!found.isEmpty()) return profile_of_file(found);
  DisplayProfile assumed;
  assumed.told = display_words("display: sRGB assumed");
  return assumed;
}

}  // namespace metamer::gui
