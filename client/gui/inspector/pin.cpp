#include "client/gui/inspector/pin.h"

#include <algorithm>

#include "client/tools/text/csv.h"
#include "common/problem.h"
#include "common/scene/probed.h"

namespace metamer::gui {
namespace {

using PinFields = std::vector<std::string>;

QByteArray csv_line(const PinFields& fields) {
  QByteArray line;
  for (const std::string& field : fields) {
    if (&field != &fields.front()) line += ',';
    line += client::csv_field(field).c_str();
  }
  return line + "\r\n";
}

template <class Values>
void add_numbers(const Values& values, std::size_t count, PinFields& row) {
  for (const double value : values) row.push_back(number_text(value));
  row.resize(row.size() + count - static_cast<std::size_t>(std::size(values)));
}

PinFields pin_heading(bool spectra) {
  PinFields row{"number", "picture", "x",  "y",  "side", "object", "material", "X",        "Y",
                "Z",      "L*",      "a*", "b*", "R",    "G",      "B",        "in gamut", "white"};
  if (!spectra) return row;
  for (const char* what : {"eye", "light", "surface"})
    for (int nm = probed_first_nm; nm <= probed_last_nm; ++nm)
      row.push_back(std::string(what) + " " + std::to_string(nm) + " nm");
  return row;
}

PinFields pin_fields(const Pin& pin, bool spectra) {
  const Spot& spot = pin.spot;
  PinFields row{std::to_string(pin.number),     spot.from.toStdString(),
                std::to_string(spot.pixel.x()), std::to_string(spot.pixel.y()),
                std::to_string(spot.side),      spot.probed.object(),
                spot.probed.material()};
  const auto& color = spot.color;
  add_numbers(
      color ? std::vector<double>(color->xyz.begin(), color->xyz.end()) : std::vector<double>(), 3,
      row);
  add_numbers(color && color->lab ? std::vector<double>{color->lab->l, color->lab->a, color->lab->b}
                                  : std::vector<double>(),
              3, row);
  add_numbers(color ? std::vector<double>(color->encoded.begin(), color->encoded.end())
                    : std::vector<double>(),
              3, row);
  row.push_back(!color ? "" : color->in_gamut ? "yes" : "no");
  row.push_back(spot.white.toStdString());
  if (!spectra) return row;
  for (const auto* values : {&spot.probed.eye(), &spot.probed.light(), &spot.probed.surface()})
    add_numbers(*values, probed_values, row);
  return row;
}

}  // namespace

QColor chip_of(const Spot& spot) {
  if (!spot.color) return {};
  const auto channel = [&](std::size_t c) {
    return static_cast<float>(std::clamp(spot.color->encoded[c], 0.0, 1.0));
  };
  return QColor::fromRgbF(channel(0), channel(1), channel(2));
}

std::optional<double> delta_e(const Spot& one, const Spot& other) {
  if (!one.color || !other.color || !one.color->lab || !other.color->lab) return std::nullopt;
  return delta_e_00(*one.color->lab, *other.color->lab);
}

QByteArray to_csv(const QList<Pin>& pins) {
  const bool spectra = std::any_of(pins.begin(), pins.end(),
                                   [](const Pin& pin) { return !pin.spot.probed.eye().empty(); });
  QByteArray text = csv_line(pin_heading(spectra));
  for (const Pin& pin : pins) text += csv_line(pin_fields(pin, spectra));
  return text;
}

}  // namespace metamer::gui
