#include "client/gui/picture/viewing.h"

#include <QList>
#include <QPointF>

namespace metamer::gui {
namespace {

constexpr int table_steps = 1024;

QPointF place_in_diagram(const Chromaticity& color) { return {color.x, color.y}; }

/// Encoded → linear, in 16 bits.
QList<uint16_t> transfer_table(const Transfer& transfer) {
  QList<uint16_t> table;
  for (int i = 0; i < table_steps; ++i) {
    const double linear = decode(transfer, i / (table_steps - 1.0));
    table << static_cast<uint16_t>(qBound(0, qRound(65535 * linear), 65535));
  }
  return table;
}

}  // namespace

QColorSpace color_space(const Developing& developing) {
  const Primaries& primaries = developing.space.primaries;
  const bool srgb = developing.space.word == rgb_space(StandardSpace::srgb).word;
  if (srgb && !developing.linear) return QColorSpace::SRgb;
  const QColorSpace linear(place_in_diagram(primaries.white), place_in_diagram(primaries.red),
                           place_in_diagram(primaries.green), place_in_diagram(primaries.blue),
                           QColorSpace::TransferFunction::Linear);
  return developing.linear ? linear
                           : linear.withTransferFunction(transfer_table(developing.space.transfer));
}

}  // namespace metamer::gui
