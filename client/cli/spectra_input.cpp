#include "client/cli/spectra_input.h"

#include <algorithm>
#include <filesystem>

#include "client/cli/gnuplot.h"
#include "client/cli/overrides.h"
#include "common/scene/files.h"
#include "common/scene/settings.h"
#include "common/spectral/cie.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;

bool looks_like_reflectance(const Spectrum& spectrum) {
  return std::all_of(spectrum.values.begin(), spectrum.values.end(),
                     [](double value) { return value >= 0 && value <= 1; });
}

tl::unexpected<Problem> no_such(const std::string& word) {
  std::vector<std::string> known = cie::illuminant_names();
  known.insert(known.end(), cie::test_color_names().begin(), cie::test_color_names().end());
  return problem("there is no file, CIE illuminant or test colour " + metamer::quoted(word) +
                 did_you_mean(word, known));
}

/// A name from a file could command a terminal.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return text;
}

/// The spectra of a file. `source` is its text, for the line of an error.
Result<std::vector<LoadedSpectrum>> read(const std::string& file, std::string& source) {
  Result<std::string> text = read_file(file, max_spectrum_file);
  if (!text) return tl::unexpected(std::move(text.error()));
  source = std::move(*text);
  return parse_spectra(source, file).map([&](std::vector<NamedSpectrum>&& spectra) {
    std::vector<LoadedSpectrum> loaded;
    for (NamedSpectrum& one : spectra)
      loaded.push_back(
          {.label = printable(one.name.empty() ? file : file + ": " + one.name),
           .name = printable(one.name.empty() ? fs::path(file).stem().string() : one.name),
           .emission = !looks_like_reflectance(one.spectrum),
           .spectrum = std::move(one.spectrum)});
    return loaded;
  });
}

Result<std::vector<LoadedSpectrum>> find(const std::string& word, std::string& source) {
  std::error_code error;
  if (fs::exists(word, error)) return read(word, source);
  const Spectrum* light = cie::illuminant(word);
  const Spectrum* paint = cie::test_color(word);
  if (light == nullptr && paint == nullptr) return no_such(word);
  return std::vector<LoadedSpectrum>{{.label = word,
                                      .name = word,
                                      .emission = light != nullptr,
                                      .spectrum = light != nullptr ? *light : *paint}};
}

/// A word, and the entry that it asks for: FILE#ENTRY, where there is no file of the whole name.
std::pair<std::string, std::optional<std::string>> split_entry(const std::string& word) {
  std::error_code error;
  const std::size_t hash = word.rfind('#');
  if (hash == std::string::npos || hash == 0 || fs::exists(word, error)) return {word, {}};
  return {word.substr(0, hash), word.substr(hash + 1)};
}

/// All spectra of a word, or the one of that name.
std::optional<std::vector<LoadedSpectrum>> load(const std::string& word,
                                                std::optional<std::string> entry, Report& report) {
  const auto [file, own_entry] = split_entry(word);
  if (own_entry) entry = own_entry;
  std::string source;
  Result<std::vector<LoadedSpectrum>> found = find(file, source);
  if (!found) {
    report.problem(found.error(), source);
    return std::nullopt;
  }
  if (!entry) return std::move(*found);
  std::vector<std::string> names;
  for (const LoadedSpectrum& one : *found) names.push_back(one.name);
  std::erase_if(*found, [&](const LoadedSpectrum& one) { return one.name != *entry; });
  if (!found->empty()) return std::move(*found);
  report.error(metamer::quoted(file) + " has no spectrum named " + metamer::quoted(*entry) +
               did_you_mean(*entry, names));
  return std::nullopt;
}

/// Settings that nothing but these words says.
Result<v1::Settings> settings_of(const Overrides& words) {
  v1::Scene scene;
  return apply(words, scene).map([&](const auto&) { return scene.settings(); });
}

SpectrumFormat format_of(const SpectraOutputOptions& options) {
  if (options.format == "pairs") return SpectrumFormat::pairs;
  if (options.format == "uniform") return SpectrumFormat::uniform;
  if (options.format == "cgats") return SpectrumFormat::cgats;
  const std::string extension = fs::path(options.file).extension().string();
  const bool cgats = extension == ".sp" || extension == ".cmf" || extension == ".ti3";
  return cgats ? SpectrumFormat::cgats : SpectrumFormat::pairs;
}

}  // namespace

std::optional<std::vector<LoadedSpectrum>> load_spectra(const SpectraOptions& options,
                                                        const std::vector<std::string>& files,
                                                        Report& report) {
  if (options.kind && *options.kind != "emission" && *options.kind != "reflectance") {
    report.error("--as: " + metamer::quoted(*options.kind) +
                 " is neither emission nor reflectance");
    return std::nullopt;
  }
  std::vector<LoadedSpectrum> all;
  for (const std::string& file : files) {
    std::optional<std::vector<LoadedSpectrum>> loaded = load(file, options.entry, report);
    if (!loaded) return std::nullopt;
    for (LoadedSpectrum& one : *loaded) {
      if (options.kind) one.emission = *options.kind == "emission";
      all.push_back(std::move(one));
    }
  }
  return all;
}

std::optional<LoadedSpectrum> load_one(const SpectraOptions& options, const std::string& file,
                                       Report& report) {
  auto loaded = load_spectra(options, {file}, report);
  if (!loaded) return std::nullopt;
  if (loaded->size() == 1) return std::move(loaded->front());
  report.error(metamer::quoted(file) + " has " + std::to_string(loaded->size()) +
               " spectra; choose one, such as " +
               metamer::quoted(file + "#" + loaded->front().name));
  return std::nullopt;
}

std::optional<Spectrum> load_light(const std::string& word, const std::string& option,
                                   Report& report) {
  SpectraOptions options;
  options.kind = "emission";
  auto light = load_one(options, word, report);
  if (!light) return std::nullopt;
  const auto& values = light->spectrum.values;
  if (*std::min_element(values.begin(), values.end()) >= 0) return std::move(light->spectrum);
  report.error(option + ": a light has no power below 0");
  return std::nullopt;
}

Result<cie::Observer> observer_of(const std::string& word) {
  Overrides words;
  words.observer = word;
  return settings_of(words).map(
      [](const v1::Settings& settings) { return to_observer(settings.observer()); });
}

Result<Wavelengths> wavelengths_of(const std::optional<std::string>& samples,
                                   const std::optional<std::string>& wavelengths) {
  Overrides words;
  words.samples = samples;
  words.wavelengths = wavelengths;
  return settings_of(words).and_then(
      [](const v1::Settings& settings) { return point_wavelengths(settings.method().point()); });
}

Wavelengths own_wavelengths(const Spectrum& spectrum) {
  const auto& nm = spectrum.nm;
  double widest = nm.size() > 1 ? 0 : 1000;
  for (std::size_t i = 1; i < nm.size(); ++i) widest = std::max(widest, nm[i] - nm[i - 1]);
  return widest <= 5 ? *Wavelengths::listed(nm) : fine_wavelengths(spectrum);
}

Wavelengths fine_wavelengths(const Spectrum& spectrum) {
  const Wavelengths by_1_nm = observer_wavelengths();
  std::vector<double> own, both = by_1_nm.nm();
  for (const double nm : spectrum.nm)
    if (nm > 360 && nm < 830) own.push_back(nm);
  both.insert(both.end(), own.begin(), own.end());
  std::sort(both.begin(), both.end());
  both.erase(std::unique(both.begin(), both.end()), both.end());
  if (both.size() <= Wavelengths::max_count) return *Wavelengths::listed(std::move(both));
  return *Wavelengths::listed(std::move(own));
}

bool check_spectra_output(const SpectraOutputOptions& options, Report& report) {
  const auto& format = options.format;
  if (!format || *format == "pairs" || *format == "uniform" || *format == "cgats") return true;
  report.error("--format: " + metamer::quoted(*format) + " is none of pairs, uniform and cgats" +
               did_you_mean(*format, {"pairs", "uniform", "cgats"}));
  return false;
}

ExitCode write_spectra(const SpectraOutputOptions& options,
                       const std::vector<NamedSpectrum>& spectra, Report& report) {
  const Result<std::string> text = spectra_text(spectra, format_of(options));
  if (!text) {
    report.error(text.error().message);
    return ExitCode::bad_input;
  }
  if (options.file.empty()) {
    report.document()["text"] = *text;
    report.line(text->substr(0, text->size() - 1));
    return ExitCode::done;
  }
  if (const Result<void> written = write_text_file(options.file, *text); !written) {
    report.problem(written.error(), {});
    return ExitCode::other;
  }
  report.document()["files"].push_back(options.file);
  report.line(options.file);
  return ExitCode::done;
}

}  // namespace metamer::cli
