#include "client/tools/spectra/resampled_set.h"

#include <algorithm>
#include <charconv>
#include <numeric>

namespace metamer::client {
namespace {

std::vector<std::size_t> text_order(const std::vector<LoadedSpectrum>& spectra, bool lights_first) {
  std::vector<std::size_t> order(spectra.size());
  std::iota(order.begin(), order.end(), 0u);
  if (lights_first)
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t i) { return spectra[i].emission(); });
  return order;
}

/// Gives a light its luminance at the new wavelengths; what it is between them are straight lines.
Result<void> normalize(const LoadedSpectrum& original, const ResampleChoice& choice,
                       ResampledRow& row) {
  if (!choice.luminance || !original.emission()) return {};
  const LoadedSpectrum made{.label = original.label,
                            .name = original.name,
                            .quantity = original.quantity,
                            .samples = row.written};
  auto changed = normalized(made, choice.observer, *choice.luminance);
  if (!changed) return tl::unexpected(std::move(changed.error()));
  row.written = std::move(changed->spectrum.spectrum);
  row.factor = changed->factor;
  return {};
}

}  // namespace

ResampledSet resampled_set(const std::vector<LoadedSpectrum>& spectra,
                           const ResampleChoice& choice) {
  ResampledSet set{.rows = {}, .text = std::string()};
  std::vector<NamedSpectrum> written;
  Result<void> sound;
  for (const std::size_t i : text_order(spectra, choice.lights_first)) {
    ResampledRow row{
        .original = i, .made = resampled(spectra[i], choice.wavelengths), .written = {}};
    row.written = row.made.spectrum.spectrum;
    if (auto done = normalize(spectra[i], choice, row); !done && sound) sound = done;
    written.push_back({.name = spectra[i].name, .spectrum = row.written});
    set.rows.push_back(std::move(row));
  }
  if (sound)
    set.text = spectra_text(written, choice.format, common_quantity(spectra));
  else
    set.text = tl::unexpected(std::move(sound.error()));
  return set;
}

Result<Wavelengths> listed_wavelengths(std::string_view text) {
  constexpr std::string_view apart = " \t\r\n,;";
  std::vector<double> nm;
  for (;;) {
    const std::size_t from = text.find_first_not_of(apart);
    if (from == std::string_view::npos) break;
    text.remove_prefix(from);
    const std::string_view word = text.substr(0, text.find_first_of(apart));
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size())
      return problem(quoted(word) + " is no wavelength");
    if (nm.size() == Wavelengths::max_count) return problem("these are too many wavelengths");
    nm.push_back(value);
    text.remove_prefix(word.size());
  }
  return Wavelengths::listed(std::move(nm));
}

}  // namespace metamer::client
