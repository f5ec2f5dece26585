#include "common/scene/rough_lobe_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/models/reference.h"

namespace metamer {
namespace {

constexpr double first_nm = 390, last_nm = 730;

double cosine_of(std::uint32_t node) {
  const double t = static_cast<double>(node / lobe_wavelengths) / (lobe_cosines - 1);
  return t * t;
}

}  // namespace

double lobe_nm(std::uint32_t wavelength) {
  const double angle = std::numbers::pi * (wavelength + 0.5) / lobe_wavelengths;
  return (first_nm + last_nm) / 2 - (last_nm - first_nm) / 2 * std::cos(angle);
}

double lobe_window(std::uint32_t wavelength, double nm) {
  const double at = std::clamp(nm, first_nm, last_nm), own = lobe_nm(wavelength);
  double value = 1;
  for (std::uint32_t i = 0; i < lobe_wavelengths; ++i)
    if (i != wavelength) value *= (at - lobe_nm(i)) / (own - lobe_nm(i));
  return value;
}

FresnelPlace lobe_place(float cosine) {
  constexpr float last = lobe_cosines - 1;
  f32::FresnelNodes nodes;
  const float below = nodes.node_below(cosine, last);
  return {static_cast<std::uint32_t>(below), nodes.node_share(cosine, below, last)};
}

const Spectrum& lobe_grid() {
  static const Spectrum grid = [] {
    Spectrum all;
    for (double nm = first_nm; nm <= last_nm; nm += 5) {
      all.nm.push_back(nm);
      all.values.push_back(1);
    }
    return all;
  }();
  return grid;
}

RoughLobeTable::RoughLobeTable(const OpticalConstants* constants, const Spectrum& specular,
                               const std::vector<double>& nm)
    : is_exact_(constants != nullptr) {
  if (is_exact_)
    constants_ = resample(*constants, nm);
  else
    specular_ = resample(specular, nm, Outside::hold).values;
  for (std::uint32_t w = 0; w < lobe_wavelengths; ++w) {
    std::vector<double>& window = windows_.emplace_back();
    for (const double one : nm) window.push_back(lobe_window(w, one));
  }
}

std::vector<double> RoughLobeTable::values(std::uint32_t node) const {
  const double cosine = cosine_of(node);
  std::vector<double> values;
  if (is_exact_)
    values = fresnel_at(constants_, cosine);
  else
    for (const double f : specular_) values.push_back(models::schlick_fresnel(cosine, f));
  const std::vector<double>& window = windows_[node % lobe_wavelengths];
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= window[i];
  return values;
}

}  // namespace metamer
