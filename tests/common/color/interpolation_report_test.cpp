// What interpolating measured reflectances buys: test colours sampled by 10 and 20 nm and read
// again. METAMER_REPORT names a file for the table.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>

#include "common/color/lab.h"
#include "common/color/table_weights.h"
#include "common/spectral/interpolation.h"

namespace metamer {
namespace {

const Observer& two_degrees = cie::observer_1931();
constexpr ValueRange all_reflectances{0, 1};

struct Loss {
  double mean = 0, most = 0;  ///< ΔE00 of the 15 test colours from what they are.
};

/// How a reflectance by `step` nm from 400 to 700 nm is read again: by a curve, or by ASTM's
/// weights.
using Reading = std::optional<Interpolation>;

const std::map<std::string, Reading>& readings() {
  static const std::map<std::string, Reading> all = {
      {"linear", Interpolation::linear},
      {"sprague", Interpolation::sprague},
      {"monotone-cubic", Interpolation::monotone_cubic},
      {"ASTM E308's weights", std::nullopt}};
  return all;
}

Loss loss_of(const Reading& reading, const Spectrum& light, double step) {
  const std::vector<double> fine = observer_wavelengths().nm();
  const ObserverWeights lit = under_light(two_degrees, light, fine);
  const Xyz white = to_xyz(lit, std::vector<double>(fine.size(), 1.0));
  const auto seen = [&](const Spectrum& paint) {
    return to_lab(to_xyz(lit, resample(paint, fine, Outside::hold).values), white);
  };
  const std::vector<double> bands = Wavelengths::uniform(400, 700, step)->nm();
  Loss loss;
  for (const std::string& name : cie::test_color_names()) {
    const Spectrum& table = *cie::test_color(name);
    const Spectrum whole =
        interpolated(table, Interpolation::sprague, all_reflectances, fine)->spectrum;
    const Spectrum samples = {bands, resample(table, bands, Outside::hold).values};
    const Lab again =
        reading ? seen(interpolated(samples, *reading, all_reflectances, fine)->spectrum)
                : to_lab(to_xyz(*weights_under(TableWeights::astm, two_degrees, light, bands),
                                samples.values),
                         white);
    const double off = delta_e_00(again, seen(whole));
    loss.mean += off / static_cast<double>(cie::test_color_names().size());
    loss.most = std::max(loss.most, off);
  }
  return loss;
}

TEST(InterpolationReport, CurvesLoseLessThanStraightLines) {
  // numpy: x̄, ȳ, z̄ and the colours by Sprague's formula (CIE 167:2005) at 1 nm, F11 by straight
  // lines, sums by 1 nm in place of integrals; the cubic by Steffen's formula.
  struct Row {
    double step;
    const char* reading;
    double mean, most;
  };
  for (const Row& row :
       {Row{20, "linear", 0.438, 0.738}, Row{20, "sprague", 0.281, 0.571},
        Row{20, "monotone-cubic", 0.270, 0.484}, Row{10, "linear", 0.233, 0.679},
        Row{10, "sprague", 0.223, 0.519}, Row{10, "monotone-cubic", 0.215, 0.504}}) {
    const Loss loss = loss_of(readings().at(row.reading), *cie::illuminant("F11"), row.step);
    EXPECT_NEAR(loss.mean, row.mean, 3e-3) << row.reading << " by " << row.step;
    EXPECT_NEAR(loss.most, row.most, 3e-3) << row.reading << " by " << row.step;
  }
}

TEST(InterpolationReport, WritesATable) {
  std::string table =
      "# Reflectances by 10 and 20 nm, read again\n\n"
      "ΔE00 of the 15 CIE test colours (400 to 700 nm) from those by 1 nm: mean, largest.\n\n"
      "| light | nm | read by | mean | largest |\n|---|---|---|---|---|\n";
  for (const char* light : {"F11", "F2", "D65", "A"})
    for (const double step : {10.0, 20.0}) {
      std::map<std::string, Loss> losses;
      for (const auto& [name, reading] : readings()) {
        const Loss loss = losses[name] = loss_of(reading, *cie::illuminant(light), step);
        char line[120];
        std::snprintf(line, sizeof line, "| %s | %g | %s | %.3f | %.3f |\n", light, step,
                      name.c_str(), loss.mean, loss.most);
        table += line;
      }
      EXPECT_LT(losses["sprague"].mean, losses["linear"].mean) << light << " by " << step;
      EXPECT_LT(losses["monotone-cubic"].mean, losses["linear"].mean) << light << " by " << step;
    }
  if (const char* wanted = std::getenv("METAMER_REPORT")) std::ofstream(wanted) << table;
}

}  // namespace
}  // namespace metamer
