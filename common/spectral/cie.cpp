#include "common/spectral/cie.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "common/spectral/cie_tables.h"

namespace metamer::cie {
namespace {

using tables::Table;

Spectrum to_spectrum(const Table& table) {
  return {.nm = {table.nm.begin(), table.nm.end()},
          .values = {table.values.begin(), table.values.end()}};
}

/// Spectra with their names, in the order of their table.
struct Catalogue {
  explicit Catalogue(std::span<const Table> tables) {
    for (const Table& table : tables) {
      names.emplace_back(table.name);
      spectra.push_back(to_spectrum(table));
    }
  }

  const Spectrum* find(std::string_view name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return nullptr;
    return &spectra[static_cast<std::size_t>(found - names.begin())];
  }

  std::vector<std::string> names;
  std::vector<Spectrum> spectra;
};

const Catalogue& illuminants() {
  static const Catalogue catalogue(tables::illuminants);
  return catalogue;
}

const Catalogue& test_colors() {
  static const Catalogue catalogue(tables::test_colors);
  return catalogue;
}

Observer::Functions three_from(std::size_t first) {
  assert(tables::observers.size() == 6);
  return {to_spectrum(tables::observers[first]), to_spectrum(tables::observers[first + 1]),
          to_spectrum(tables::observers[first + 2])};
}

}  // namespace

const Observer& observer_1931() {
  static const Observer observer("cie-1931-2deg", three_from(0));
  return observer;
}

const Observer& observer_1964() {
  static const Observer observer("cie-1964-10deg", three_from(3));
  return observer;
}

const Spectrum* illuminant(std::string_view name) { return illuminants().find(name); }
const std::vector<std::string>& illuminant_names() { return illuminants().names; }

const Spectrum* test_color(std::string_view name) { return test_colors().find(name); }
const std::vector<std::string>& test_color_names() { return test_colors().names; }

const std::array<Spectrum, 3>& daylight_components() {
  static const std::array<Spectrum, 3> components = {to_spectrum(tables::daylight[0]),
                                                     to_spectrum(tables::daylight[1]),
                                                     to_spectrum(tables::daylight[2])};
  return components;
}

}  // namespace metamer::cie
