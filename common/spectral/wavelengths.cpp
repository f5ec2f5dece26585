#include "common/spectral/wavelengths.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>

namespace metamer {
namespace {

std::string too_many() {
  return "at most " + std::to_string(Wavelengths::max_count) + " wavelengths are possible";
}

/// The cells of Fig. 4-2.
std::vector<double> cell_widths(const std::vector<double>& nm) {
  const std::size_t count = nm.size();
  if (count == 1) return {1.0};
  std::vector<double> widths(count);
  widths.front() = nm[1] - nm[0];
  widths.back() = nm[count - 1] - nm[count - 2];
  for (std::size_t i = 1; i + 1 < count; ++i) widths[i] = (nm[i + 1] - nm[i - 1]) / 2;
  return widths;
}

}  // namespace

std::optional<std::string> wrong_positions(const std::vector<double>& nm) {
  if (nm.empty()) return "no wavelengths";
  for (std::size_t i = 0; i < nm.size(); ++i) {
    if (!std::isfinite(nm[i])) return "wavelength " + number_text(nm[i]) + " is not finite";
    if (nm[i] <= 0) return "wavelength " + number_text(nm[i]) + " must be above 0 nm";
    if (i == 0) continue;
    if (nm[i] == nm[i - 1]) return "wavelength " + number_text(nm[i]) + " is repeated";
    if (nm[i] < nm[i - 1]) {
      return "wavelengths must rise: " + number_text(nm[i]) + " follows " + number_text(nm[i - 1]);
    }
  }
  return std::nullopt;
}

Wavelengths::Wavelengths(std::vector<double> nm) : nm_(std::move(nm)), widths_(cell_widths(nm_)) {}

Wavelengths::Wavelengths(std::vector<double> nm, std::vector<double> widths)
    : nm_(std::move(nm)), widths_(std::move(widths)) {}

Wavelengths Wavelengths::weighted(std::vector<double> nm, std::vector<double> widths) {
  assert(!nm.empty() && nm.size() == widths.size());
  return {std::move(nm), std::move(widths)};
}

Result<Wavelengths> Wavelengths::uniform(double from, double to, double step) {
  // Check the three numbers.
  for (const double number : {from, to, step}) {
    if (!std::isfinite(number)) {
      return problem("wavelengths must be finite numbers, not " + number_text(number));
    }
  }
  if (from <= 0) return problem("wavelength " + number_text(from) + " must be above 0 nm");
  if (to < from) {
    return problem("the last wavelength, " + number_text(to) + ", is below the first, " +
                   number_text(from));
  }
  if (step <= 0) return problem("the step must be above 0 nm, not " + number_text(step));

  // Count before allocating: a tiny step means any number of samples.
  const double steps = std::floor((to - from) / step + 1e-6);
  if (!(steps < static_cast<double>(max_count))) {
    return problem(too_many() + "; " + number_text(from) + " to " + number_text(to) + " by " +
                   number_text(step) + " are more");
  }
  std::vector<double> nm(static_cast<std::size_t>(steps) + 1);
  for (std::size_t i = 0; i < nm.size(); ++i) nm[i] = from + static_cast<double>(i) * step;

  // End exactly where it was asked to, free of the product's rounding.
  if (std::abs(nm.back() - to) <= 1e-6 * step && nm.size() > 1) nm.back() = to;

  // A step below the resolution of a double near `from` repeats positions.
  if (auto wrong = wrong_positions(nm)) return problem(std::move(*wrong));
  return Wavelengths(std::move(nm));
}

Result<Wavelengths> Wavelengths::listed(std::vector<double> nm) {
  if (nm.size() > max_count) return problem(too_many() + ", not " + std::to_string(nm.size()));
  if (auto wrong = wrong_positions(nm)) return problem(std::move(*wrong));
  return Wavelengths(std::move(nm));
}

Wavelengths observer_wavelengths() {
  return *Wavelengths::uniform(observer_from_nm, observer_to_nm, 1);
}

}  // namespace metamer
