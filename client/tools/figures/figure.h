#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace metamer::client {

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// A function of an angle, as it is drawn and as it stands in the .csv.
struct Curve {
  std::string label;                ///< "θ = 30°"
  std::vector<double> angle;        ///< Degrees, rising.
  std::vector<double> value;        ///< As many; finite and not negative.
  std::optional<double> incidence;  ///< Degrees: a polar panel shows where this light comes from.
};

struct Panel {
  std::string title;
  bool polar = false;      ///< Around the normal, -90° to 90°; else over a straight axis.
  std::string angle = "";  ///< What the angle is: "viewing angle"
  std::string value = "";  ///< What the value is: "ρ"
  std::vector<Curve> curves;
};

/// A picture: panels side by side. Those of one shape have one scale, so that they compare.
struct Figure {
  std::string name;  ///< Of its files, without the extension: "fig-2-6".
  std::string title;
  std::string citation;  ///< The last lines of the picture, which are wrapped to fit.
  int columns = 1;       ///< Panels in a row.
  std::vector<Panel> panels;
};

/// The table behind a figure: a line a point, `panel,curve,degrees,value` (RFC 4180, UTF-8). The
/// numbers read back as the same doubles.
std::string csv_text(const Figure& figure);

/// A value at or above every curve's, and a step into which it divides: the scale of the panels of
/// that shape.
struct Scale {
  double top, step;
};
Scale scale_of(const Figure& figure, bool polar);

}  // namespace metamer::client
