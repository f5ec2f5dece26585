#include <algorithm>
#include <map>
#include <utility>

#include "common/scene/check_spectrum.h"
#include "common/scene/findings.h"
#include "common/scene/interpolated.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"
#include "common/scene/settings.h"
#include "common/scene/validate.h"
#include "common/spectral/cie.h"
#include "common/spectral/files/observer_file.h"
#include "common/spectral/files/spectrum_file.h"
#include "common/spectral/lines.h"

namespace metamer {

namespace {

using Spectra = Result<std::vector<NamedSpectrum>>;

Spectra read_spectra(const std::string& name, const AssetReader& assets) {
  const auto bytes = assets(name);
  if (!bytes) return tl::unexpected(bytes.error());
  return parse_spectra(*bytes, name);
}

tl::unexpected<Problem> at(const std::string& field, Problem problem) {
  problem.field = field;
  return tl::unexpected(std::move(problem));
}

/// Finds a value out of the role's range in a spectrum from a file.
Result<Spectrum> check_role(Spectrum spectrum, const v1::Spectrum& message,
                            const std::string& field, SpectrumRole role) {
  const std::string which = message.entry().empty() ? quoted(message.file())
                                                    : "entry " + quoted(message.entry()) + " of " +
                                                          quoted(message.file());
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i) {
    const std::string wrong = value_fault(spectrum.values[i], role);
    if (wrong.empty()) continue;
    return at(field + ".file", {.field = {},
                                .file = {},
                                .message = which + " has " + number_text(spectrum.values[i]) +
                                           " at " + number_text(spectrum.nm[i]) + " nm; " + wrong});
  }
  if (role == SpectrumRole::emission && is_dark(spectrum.values)) {
    return at(field + ".file",
              {.field = {}, .file = {}, .message = which + " is 0 at every wavelength"});
  }
  return spectrum;
}

Result<Spectrum> choose(const Spectra& spectra, const v1::Spectrum& message,
                        const std::string& field, SpectrumRole role) {
  if (!spectra) return at(field + ".file", spectra.error());
  auto chosen = select_entry(*spectra, message.entry());
  if (!chosen) {
    const bool named = !message.entry().empty();
    return at(field + (named ? ".entry" : ".file"), std::move(chosen.error()));
  }
  return check_role(*std::move(chosen), message, field, role);
}

/// What measured data are between their samples.
Result<Spectrum> between_samples(Result<Spectrum> samples, const v1::Spectrum& message,
                                 const std::string& field, SpectrumRole role) {
  if (!samples) return samples;
  auto curve = interpolated(*samples, interpolation_of(message), role);
  if (!curve) return at(field + ".interpolation", std::move(curve.error()));
  return std::move(curve->spectrum);
}

/// An emission with its lines; `continuum` may have no samples.
Spectrum with_lines_of(const v1::Spectrum& message, Spectrum continuum) {
  if (message.line().empty()) return continuum;
  std::vector<Line> lines;
  for (const v1::Line& line : message.line()) lines.push_back({line.nm(), line.power()});
  return with_lines(continuum.nm.empty() ? continuum : as_emission(std::move(continuum)), lines);
}

/// The source of a message, as it is used; without samples where it has lines alone.
Result<Spectrum> load_source(const v1::Spectrum& message, const std::string& field,
                             SpectrumRole role, const AssetReader& assets) {
  switch (message.source_case()) {
    case v1::Spectrum::kStandard:
      return *cie::illuminant(message.standard());
    case v1::Spectrum::kConstant:
      return Spectrum{{limits::min_wavelength, limits::max_wavelength},
                      {message.constant(), message.constant()}};
    case v1::Spectrum::kSamples:
      return between_samples(to_spectrum(message.samples()), message, field, role);
    case v1::Spectrum::kFile:
      return between_samples(choose(read_spectra(message.file(), assets), message, field, role),
                             message, field, role);
    case v1::Spectrum::SOURCE_NOT_SET:
      break;
  }
  return Spectrum{};
}

}  // namespace

Result<Spectrum> load_spectrum(const v1::Spectrum& message, const std::string& field,
                               SpectrumRole role, const AssetReader& assets) {
  // Whatever can be seen without the file is checked in one place.
  Findings findings;
  check_spectrum(message, field, role, findings);
  if (findings.size() > 0) return tl::unexpected(findings.take().front());
  return load_source(message, field, role, assets).map([&](Spectrum&& source) {
    return with_lines_of(message, std::move(source));
  });
}

Result<Observer> load_observer(const v1::Settings& settings, const std::string& field,
                               const AssetReader& assets) {
  const std::string& file = settings.observer_file();
  if (file.empty()) return to_observer(settings.observer());
  auto observer =
      assets(file).and_then([&](const std::string& bytes) { return parse_observer(bytes, file); });
  if (!observer) return at(field + ".observer_file", std::move(observer.error()));
  return observer;
}

std::vector<Problem> validate_spectra(const v1::Scene& scene, const AssetReader& assets) {
  std::map<std::string, Spectra> read;
  Findings findings;
  for_each_spectrum(scene, [&](const v1::Spectrum& message, const std::string& field,
                               SpectrumRole role) {
    Result<Spectrum> spectrum = problem("");
    if (message.source_case() == v1::Spectrum::kFile) {
      // Read a file once, however many entries are used, and report once that it can't be read.
      auto [file, is_new] = read.try_emplace(message.file(), problem(""));
      if (is_new) file->second = read_spectra(message.file(), assets);
      if (!is_new && !file->second) return;
      spectrum = between_samples(choose(file->second, message, field, role), message, field, role);
    } else {
      spectrum = load_spectrum(message, field, role, assets);
    }
    if (!spectrum) findings.add(std::move(spectrum.error()));
  });
  if (auto observer = load_observer(scene.settings(), "settings", assets); !observer)
    findings.add(std::move(observer.error()));
  return findings.take();
}

}  // namespace metamer
