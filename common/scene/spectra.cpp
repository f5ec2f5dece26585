#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "common/color/illuminants.h"
#include "common/color/sunlight.h"
#include "common/image/pixel_spectrum.h"
#include "common/scene/check_spectrum.h"
#include "common/scene/findings.h"
#include "common/scene/fluorescence.h"
#include "common/scene/interpolated.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"
#include "common/scene/reading.h"
#include "common/scene/settings.h"
#include "common/scene/validate.h"
#include "common/spectral/files/observer_file.h"
#include "common/spectral/files/spectrum_file.h"
#include "common/spectral/lines.h"

namespace metamer {

namespace {

using File = Result<SpectrumFile>;

/// What of a message decides what its file holds: of a picture also the pixel.
using FileKey = std::tuple<std::string, int, std::string>;
FileKey file_key(const v1::Spectrum& message) {
  return {message.file(), message.reading().unit(),
          is_picture_of_spectra(message.file()) ? message.entry() : std::string()};
}

File read_file_of(const v1::Spectrum& message, const AssetReader& assets) {
  const auto bytes = assets(message.file());
  if (!bytes) return tl::unexpected(bytes.error());
  if (is_picture_of_spectra(message.file()))
    return read_pixel_spectrum({*bytes, message.file()}, message.entry());
  return read_spectrum_file(*bytes, message.file(), reading_of(message.reading()).unit);
}

tl::unexpected<Problem> at(const std::string& field, Problem problem) {
  problem.field = field;
  return tl::unexpected(std::move(problem));
}

/// The file of a message and its entry, for people.
std::string which_of(const v1::Spectrum& message) {
  return message.entry().empty()
             ? quoted(message.file())
             : "entry " + quoted(message.entry()) + " of " + quoted(message.file());
}

/// Finds a value out of the role's range in a spectrum from a file.
Result<Spectrum> check_role(Spectrum spectrum, const v1::Spectrum& message,
                            const std::string& field, SpectrumRole role) {
  const std::string which = which_of(message);
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

/// What measured data are between their samples.
Result<Spectrum> between_samples(Result<Spectrum> samples, const v1::Spectrum& message,
                                 const std::string& field, SpectrumRole role) {
  if (!samples) return samples;
  auto curve = interpolated(*samples, interpolation_of(message), role);
  if (!curve) return at(field + ".interpolation", std::move(curve.error()));
  return std::move(curve->spectrum);
}

/// The spectrum of a file that a message asks for, as its role needs it.
Result<NotedSpectrum> choose(const File& file, const v1::Spectrum& message,
                             const std::string& field, SpectrumRole role) {
  if (!file) return at(field + ".file", file.error());
  auto chosen = select_entry(file->spectra, message.entry());
  if (!chosen) {
    const bool named = !message.entry().empty();
    return at(field + (named ? ".entry" : ".file"), std::move(chosen.error()));
  }
  auto read = as_role(*file, std::move(*chosen), reading_of(message.reading()), role);
  if (!read) {
    read.error().message = which_of(message) + ": " + read.error().message;
    return at(field + ".file", std::move(read.error()));
  }
  auto curve = between_samples(check_role(std::move(read->spectrum), message, field, role), message,
                               field, role);
  if (!curve) return tl::unexpected(std::move(curve.error()));
  if (role == SpectrumRole::emission && curve->nm.size() == 1)
    read->notes.push_back("a line, as it has a single sample, at " +
                          number_text(curve->nm.front()) + " nm");
  for (std::string& note : read->notes) note = which_of(message) + ": " + note;
  return NotedSpectrum{*std::move(curve), std::move(read->notes)};
}

/// An emission with its lines; `continuum` may have no samples.
Spectrum with_lines_of(const v1::Spectrum& message, Spectrum continuum) {
  if (message.line().empty()) return continuum;
  std::vector<Line> lines;
  for (const v1::Line& line : message.line()) lines.push_back({line.nm(), line.power()});
  return with_lines(continuum.nm.empty() ? continuum : as_emission(std::move(continuum)), lines);
}

Spectrum sunlight_of(const v1::Sunlight& message) {
  return sunlight(message.has_turbidity() ? message.turbidity() : usual_turbidity,
                  message.has_elevation() ? message.elevation() : usual_elevation);
}

/// The source of a message, as it is used; without samples where it has lines alone.
Result<NotedSpectrum> load_source(const v1::Spectrum& message, const std::string& field,
                                  SpectrumRole role, const AssetReader& assets) {
  const auto silent = [](Spectrum&& spectrum) { return NotedSpectrum{std::move(spectrum)}; };
  switch (message.source_case()) {
    case v1::Spectrum::kStandard:
      return illuminant_named(message.standard()).map(silent);
    case v1::Spectrum::kConstant:
      return silent({{limits::min_wavelength, limits::max_wavelength},
                     {message.constant(), message.constant()}});
    case v1::Spectrum::kSamples:
      return between_samples(to_spectrum(message.samples()), message, field, role).map(silent);
    case v1::Spectrum::kFile:
      return choose(read_file_of(message, assets), message, field, role);
    case v1::Spectrum::kSunlight:
      return silent(sunlight_of(message.sunlight()));
    case v1::Spectrum::SOURCE_NOT_SET:
      break;
  }
  return NotedSpectrum{};
}

}  // namespace

Result<NotedSpectrum> load_noted_spectrum(const v1::Spectrum& message, const std::string& field,
                                          SpectrumRole role, const AssetReader& assets) {
  // Whatever can be seen without the file is checked in one place.
  Findings findings;
  check_spectrum(message, field, role, findings);
  if (findings.size() > 0) return tl::unexpected(findings.take().front());
  return load_source(message, field, role, assets).map([&](NotedSpectrum&& source) {
    return NotedSpectrum{with_lines_of(message, std::move(source.spectrum)),
                         std::move(source.notes)};
  });
}

Result<Spectrum> load_spectrum(const v1::Spectrum& message, const std::string& field,
                               SpectrumRole role, const AssetReader& assets) {
  return load_noted_spectrum(message, field, role, assets).map([](NotedSpectrum&& noted) {
    return std::move(noted.spectrum);
  });
}

namespace {

Result<Observer> observer_of_file(const std::string& file, const std::string& field,
                                  const AssetReader& assets) {
  auto observer =
      assets(file).and_then([&](const std::string& bytes) { return parse_observer(bytes, file); });
  if (!observer) return at(field, std::move(observer.error()));
  return observer;
}

}  // namespace

Result<Observer> load_observer(const v1::Settings& settings, const std::string& field,
                               const AssetReader& assets) {
  if (settings.observer_file().empty()) return to_observer(settings.observer());
  return observer_of_file(settings.observer_file(), field + ".observer_file", assets);
}

std::vector<Problem> validate_spectra(const v1::Scene& scene, const AssetReader& assets) {
  // A file is read once in each unit, however many entries are used, and that it can't be read is
  // reported once.
  std::map<FileKey, File> read;
  Findings findings;
  for_each_spectrum(scene,
                    [&](const v1::Spectrum& message, const std::string& field, SpectrumRole role) {
                      Result<NotedSpectrum> spectrum = problem("");
                      if (message.source_case() == v1::Spectrum::kFile) {
                        auto [file, is_new] = read.try_emplace(file_key(message), problem(""));
                        if (is_new) file->second = read_file_of(message, assets);
                        if (!is_new && !file->second) return;
                        spectrum = choose(file->second, message, field, role);
                      } else {
                        spectrum = load_noted_spectrum(message, field, role, assets);
                      }
                      if (!spectrum) findings.add(std::move(spectrum.error()));
                    });
  for_each_observer_file(scene, [&](const std::string& file, const std::string& field) {
    if (auto observer = observer_of_file(file, field, assets); !observer)
      findings.add(std::move(observer.error()));
  });
  check_fluorescences(scene, assets, findings);
  return findings.take();
}

}  // namespace metamer
