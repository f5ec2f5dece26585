#include "client/cli/commands/spectra/spectra_input.h"

#include "client/cli/output/gnuplot.h"
#include "client/cli/overrides.h"
#include "client/tools/scene/observers.h"
#include "common/scene/settings.h"

namespace metamer::cli {
namespace {

using client::LoadedSpectrum;

/// What the options say of files. The words are among their choices.
client::SpectrumChoice choice_of(const SpectraOptions& options) {
  client::SpectrumChoice choice{.entry = options.entry, .use = options.use};
  if (options.interpolation) choice.interpolation = find_interpolation(*options.interpolation);
  if (options.as)
    choice.reading.as = *options.as == "emission"        ? Quantity::emission
                        : *options.as == "transmittance" ? Quantity::transmittance
                                                         : Quantity::reflectance;
  if (options.unit)
    choice.reading.unit = *options.unit == "um" ? WavelengthUnit::um : WavelengthUnit::nm;
  if (options.scale)
    choice.reading.scale = *options.scale == "percent" ? Scale::percent : Scale::one;
  choice.reading.clamp = options.clamp;
  return choice;
}

/// What was loaded; else says why nothing was.
template <class T>
std::optional<T> loaded_or_told(client::SpectrumResult<T>&& loaded, Report& report) {
  if (loaded) return std::move(*loaded);
  const client::SpectrumFault& fault = loaded.error();
  if (fault.choice)
    report.error(fault.problem.message);
  else
    report.problem(fault.problem, fault.source);
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
  return client::format_for(options.file);
}

}  // namespace

void declare_spectra(SpectraOptions& values, Options& options, bool single) {
  options.push_back(
      {.names = "files",
       .target = &values.files,
       .meaning = "spectrum files, or names of the CIE's illuminants and test colours: D65 TCS09",
       .required = true,
       .single = single});
  options.push_back({.names = "--entry,--column",
                     .target = &values.entry,
                     .meaning = "of files with several spectra, the one so named"});
  options.push_back({.names = "--as",
                     .target = &values.as,
                     .meaning = "what files hold; else as they say, else a reflectance where all "
                                "values lie in 0..1",
                     .choices = {"reflectance", "transmittance", "emission"}});
  options.push_back({.names = "--unit",
                     .target = &values.unit,
                     .meaning = "of files' wavelengths; else as they say",
                     .choices = {"nm", "um"}});
  options.push_back({.names = "--scale",
                     .target = &values.scale,
                     .meaning = "of reflectances in files; else as they say, else percent above 5",
                     .choices = {"1", "percent"}});
  options.push_back({.names = "--clamp",
                     .target = &values.clamp,
                     .meaning = "values out of 0..1, or of lights below 0, become the nearest in "
                                "range"});
  options.push_back({.names = "--interpolation",
                     .target = &values.interpolation,
                     .meaning = "what files are between their samples; else as in a scene: a curve "
                                "where data are smooth and more than 1 nm apart",
                     .choices = interpolation_words()});
  declare_json(values.json, options);
}

void declare_observer(SpectraOptions& values, Options& options) {
  options.push_back({.names = "--observer",
                     .target = &values.observer,
                     .meaning = observer_meaning,
                     .shows_default = true});
}

void declare_under(SpectraOptions& values, Options& options) {
  options.push_back({.names = "--under",
                     .target = &values.under,
                     .meaning = std::string("the light of reflectances: ") + light_words,
                     .shows_default = true});
}

void declare_spectra_output(SpectraOutputOptions& values, Options& options, bool required) {
  options.push_back({.names = "--format",
                     .target = &values.format,
                     .meaning = "pairs, uniform or cgats; else by the file's name: .sp is CGATS"});
  options.push_back({.names = "-o,--output",
                     .target = &values.file,
                     .meaning = "a file; printed when left out",
                     .required = required});
}

ExitCode refuse(const std::string& why, Report& report) {
  report.error(why);
  return report.finish(ExitCode::bad_input);
}

std::optional<std::vector<LoadedSpectrum>> load_spectra(const SpectraOptions& options,
                                                        const std::vector<std::string>& files,
                                                        Report& report) {
  return loaded_or_told(client::load_spectra(files, choice_of(options)), report);
}

std::optional<LoadedSpectrum> load_one(const SpectraOptions& options, const std::string& file,
                                       Report& report) {
  return loaded_or_told(client::load_one(file, choice_of(options)), report);
}

void tell_notes(const LoadedSpectrum& one, Report& report) {
  for (const std::string& note : one.notes)
    report.note({.field = {}, .file = {}, .message = one.label + ": " + note});
}

std::optional<Spectrum> load_for(Use use, const std::string& file, Report& report) {
  auto loaded = loaded_or_told(client::load_one(file, {.use = use}), report);
  if (!loaded) return std::nullopt;
  tell_notes(*loaded, report);
  return loaded->spectrum();
}

void tell_ends(const std::string& label, const std::string& ends, Report& report) {
  if (!ends.empty()) report.note({.field = {}, .file = {}, .message = label + ": " + ends});
}

void tell_ends_of(const std::vector<LoadedSpectrum>& spectra,
                  const std::vector<CumulativeLight>& lights, const Observer& observer,
                  Report& report) {
  for (const LoadedSpectrum& one : spectra)
    tell_ends(one.label,
              one.emission() ? ends_of_light(one.spectrum(), observer)
                             : ends_of_property(one.spectrum(), lights),
              report);
}

std::optional<Spectrum> load_light(const std::string& word, const std::string& option,
                                   const Observer& observer, Report& report) {
  auto loaded = client::load_one(word, {.use = Use::emission});
  if (!loaded && loaded.error().problem.line == 0)
    loaded.error().problem.message.insert(0, option + ": ");
  auto light = loaded_or_told(std::move(loaded), report);
  if (!light) return std::nullopt;
  tell_notes(*light, report);
  const std::string fault = light->emission()
                                ? client::emission_fault(light->samples)
                                : metamer::quoted(word) + " is a reflectance, no light";
  if (fault.empty()) {
    tell_ends(light->label, ends_of_light(light->spectrum(), observer), report);
    return light->spectrum();
  }
  report.error(option + ": " + fault);
  return std::nullopt;
}

std::optional<Observer> load_observer(const std::string& word, Report& report) {
  auto observer = client::load_observer(word);
  if (!observer && observer.error().choice)
    observer.error().problem.message.insert(0, "--observer: ");
  if (observer && observer->is_cut())
    report.note(
        {.field = {}, .file = word, .message = "what it sees outside 360 to 830 nm is left out"});
  if (observer) tell_ends(word, ends_of_observer(*observer), report);
  return loaded_or_told(std::move(observer), report);
}

Result<Wavelengths> wavelengths_of(const std::optional<std::string>& samples,
                                   const std::optional<std::string>& wavelengths) {
  Overrides words;
  words.samples = samples;
  words.wavelengths = wavelengths;
  return settings_of(words).and_then(
      [](const v1::Settings& settings) { return point_wavelengths(settings.method().point()); });
}

bool check_spectra_output(const SpectraOutputOptions& options, Report& report) {
  const auto& format = options.format;
  if (!format || *format == "pairs" || *format == "uniform" || *format == "cgats") return true;
  report.error("--format: " + metamer::quoted(*format) + " is none of pairs, uniform and cgats" +
               did_you_mean(*format, {"pairs", "uniform", "cgats"}));
  return false;
}

/// What readers of the file are not told.
void note_unsaid(SpectrumFormat format, std::optional<Quantity> quantity, Report& report) {
  if (!quantity)
    report.note({.field = {},
                 .file = {},
                 .message = "lights and surfaces in one file: it does not say what they are"});
  else if (format != SpectrumFormat::cgats && *quantity != Quantity::reflectance)
    report.note({.field = {},
                 .file = {},
                 .message = "a plain file does not say that it is " +
                            std::string(*quantity == Quantity::emission ? "an " : "a ") +
                            quantity_text(*quantity) +
                            ": --as says it where it is read, or write CGATS"});
}

ExitCode write_spectra(const SpectraOutputOptions& options,
                       const std::vector<NamedSpectrum>& spectra, std::optional<Quantity> quantity,
                       Report& report) {
  const SpectrumFormat format = format_of(options);
  const Result<std::string> text = spectra_text(spectra, format, quantity);
  if (text) note_unsaid(format, quantity, report);
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
