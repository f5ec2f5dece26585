#include "common/spectral/files/observer_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/spectral/files/labels.h"
#include "common/spectral/files/spectrum_file.h"

namespace metamer {
namespace {

/// Where x̄, ȳ and z̄ stand among three spectra.
std::array<std::size_t, 3> places_of(const std::vector<NamedSpectrum>& spectra) {
  std::array<std::size_t, 3> places = {3, 3, 3};
  for (std::size_t i = 0; i < spectra.size(); ++i) {
    const char begin = spectra[i].name.empty() ? ' ' : spectra[i].name.front();
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (begin == "xyz"[axis] || begin == "XYZ"[axis]) places[axis] = i;
  }
  for (const std::size_t place : places)
    if (place == 3) return {0, 1, 2};
  return places;
}

/// What spectra are by the first letters of their names, where they are another three. Empty: they
/// are not.
std::string other_three(const std::vector<NamedSpectrum>& spectra) {
  std::string letters;
  for (const NamedSpectrum& one : spectra)
    letters += one.name.empty() ? ' ' : spectrum_text::lower(one.name).front();
  std::sort(letters.begin(), letters.end());
  if (letters == "lms")
    return "its columns are l, m and s, cone fundamentals: x, y and z are sums of them (CIE 170-2)";
  if (letters == "bgr")
    return "its columns are r, g and b, colour matching functions of primaries: x, y and z are "
           "sums "
           "of them";
  return {};
}

}  // namespace

Result<Observer> parse_observer(std::string_view bytes, const std::string& file) {
  auto spectra = parse_spectra(bytes, file);
  if (!spectra) return tl::unexpected(std::move(spectra.error()));
  const auto failed = [&](std::string message) {
    return tl::unexpected(Problem{.field = {}, .file = file, .message = std::move(message)});
  };
  if (spectra->size() != 3)
    return failed("is no observer: that has three spectra, x, y and z, and not " +
                  std::to_string(spectra->size()));
  if (const std::string other = other_three(*spectra); !other.empty())
    return failed("is no observer: " + other);
  Observer::Functions tables;
  const std::array<std::size_t, 3> places = places_of(*spectra);
  for (std::size_t i = 0; i < 3; ++i) tables[i] = std::move((*spectra)[places[i]].spectrum);
  Result<Observer> observer = make_observer(file, tables);
  if (!observer) return failed("is no observer: " + observer.error().message);
  return observer;
}

}  // namespace metamer
