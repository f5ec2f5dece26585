#pragma once

#include <QColor>
#include <QPoint>
#include <QString>
#include <optional>

#include "client/tools/pictures/pixel_reading.h"
#include "metamer/v1/views.pb.h"

namespace metamer::gui {

/// What is known of a place in a picture.
struct Spot {
  QString from;  ///< The picture.
  QPoint pixel;
  int side = 1;  ///< Of the square that the colour is a mean of.
  std::optional<client::PixelReading> color;
  std::optional<Xyz> spread = {};  ///< Of X, Y and Z over the square, where its pixels are known.
  QString white;                   ///< What looks white, for people.
  v1::Probed probed;  ///< Object, material and spectra; empty where they are not known.
};

/// A spot that is kept.
struct Pin {
  int number = 0;
  Spot spot;
};

/// The colour on a screen of sRGB, clipped; invalid where none is known.
QColor chip_of(const Spot& spot);
/// ΔE00; nothing where one has no colour.
std::optional<double> delta_e(const Spot& one, const Spot& other);
/// A line a pin, with spectra in a column a nanometre where any pin has them.
QByteArray to_csv(const QList<Pin>& pins);

}  // namespace metamer::gui
