#pragma once

#include <QColorSpace>
#include <QString>

class QDBusConnection;

namespace metamer::gui {

/// What numbers mean on a display.
struct DisplayProfile {
  QColorSpace space{QColorSpace::SRgb};
  QString told;  ///< For people: "display: sRGB assumed".
};

/// Of an ICC profile that has a matrix, which is what Qt 6.4 reads; sRGB in the place of any other,
/// which is told. Waits for the file.
DisplayProfile profile_of_file(const QString& file);

/// The file of the profile that colord has for an output ("eDP-1"); empty: it has none, or there is
/// no colord. `service` is its name on this bus; waits for it, 3 s at most.
QString colord_profile(const QDBusConnection& bus, const QString& service, const QString& output);

/// What was chosen by hand (`file`), else what colord has, else sRGB.
DisplayProfile find_display(const QDBusConnection& bus, const QString& service,
                            const QString& output, const QString& file);

}  // namespace metamer::gui
