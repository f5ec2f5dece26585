// Which paint matches: several beside one, under several lights.
#include <algorithm>
#include <filesystem>
#include <iterator>

#include "client/cli/commands.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/cli/output/gnuplot.h"
#include "client/tools/pictures/swatches.h"
#include "client/tools/spectra/paint_match.h"
#include "client/tools/spectra/spectrum_word.h"
#include "client/tools/text/csv.h"
#include "client/tools/text/formatted.h"

namespace metamer::cli {
namespace {

using client::formatted;
using client::PaintMatch;

struct MatchOptions {
  SpectraOptions input;
  std::vector<std::string> lights = {"D65", "A", "F11"};
  std::optional<double> max;         ///< A nearest candidate that is farther is a failure.
  std::vector<std::string> outputs;  ///< A .png of swatches, a .csv of the table.
};

bool is_csv(const std::string& file) { return std::filesystem::path(file).extension() == ".csv"; }

/// What is compared; nothing where something can't be read, which is said.
struct Paints {
  client::LoadedSpectrum reference;
  std::vector<NamedSpectrum> candidates, lights;
};

bool same_file(const std::string& word, const std::string& other) {
  const auto one = client::parse_spectrum_word(word), two = client::parse_spectrum_word(other);
  std::error_code error;
  return one && two && one->is_file && two->is_file &&
         std::filesystem::equivalent(one->name, two->name, error);
}

/// The spectra of the words, without the reference where a word brings it among others of its file.
std::optional<std::vector<client::LoadedSpectrum>> load_candidates(
    const SpectraOptions& input, const client::LoadedSpectrum& reference, Report& report) {
  std::vector<client::LoadedSpectrum> candidates;
  for (auto word = input.files.begin() + 1; word != input.files.end(); ++word) {
    auto some = load_spectra(input, {*word}, report);
    if (!some) return std::nullopt;
    if (some->size() > 1 && same_file(*word, input.files.front()))
      std::erase_if(*some, [&](const client::LoadedSpectrum& one) {
        return one.name == reference.name && one.samples == reference.samples;
      });
    std::move(some->begin(), some->end(), std::back_inserter(candidates));
  }
  if (!candidates.empty()) return candidates;
  report.error("there is no candidate but the reference itself");
  return std::nullopt;
}

std::optional<Paints> load_paints(const MatchOptions& options, const Observer& observer,
                                  Report& report) {
  SpectraOptions input = options.input;
  input.use = Use::property;
  auto reference = load_one(input, input.files.front(), report);
  if (!reference) return std::nullopt;
  auto candidates = load_candidates(input, *reference, report);
  if (!candidates) return std::nullopt;
  Paints paints{.reference = std::move(*reference), .candidates = {}, .lights = {}};
  std::vector<const client::LoadedSpectrum*> all = {&paints.reference};
  for (const client::LoadedSpectrum& one : *candidates) {
    all.push_back(&one);
    paints.candidates.push_back({.name = one.label, .spectrum = one.spectrum()});
  }
  for (const client::LoadedSpectrum* one : all) {
    tell_notes(*one, report);
    if (!one->emission()) continue;
    report.error(one->label + ": it is an emission, and reflectances are compared");
    return std::nullopt;
  }
  std::vector<CumulativeLight> seen;
  for (const std::string& word : options.lights) {
    auto light = load_light(word, "--under", observer, report);
    if (!light) return std::nullopt;
    seen.emplace_back(word, *light, observer);
    paints.lights.push_back({.name = word, .spectrum = std::move(*light)});
  }
  candidates->insert(candidates->begin(), paints.reference);
  tell_ends_of(*candidates, seen, observer, report);
  return paints;
}

Json json_of(const PaintMatch& match) {
  Json json = {{"name", match.name}, {"under", Json::array()}};
  for (std::size_t i = 0; i < match.under.size(); ++i) {
    const Mismatch& under = match.under[i];
    json["under"].push_back({{"light", under.light},
                             {"de00", under.de00},
                             {"deab", under.deab},
                             {"metamerism_de00", match.index[i].de00},
                             {"metamerism_deab", match.index[i].deab}});
  }
  json["worst"] = {{"light", match.under[match.worst].light}, {"de00", match.worst_de00()}};
  return json;
}

/// A table of people's: a line for each candidate, a column for each light.
void print_table(const std::vector<PaintMatch>& matches, Report& report) {
  std::size_t name_width = 9;
  for (const PaintMatch& match : matches) name_width = std::max(name_width, match.name.size());
  const auto name = [&](std::string text) {
    text.resize(name_width, ' ');
    return text;
  };
  std::string heading = name("");
  for (const Mismatch& under : matches.front().under)
    heading += formatted("  %20s", under.light.c_str());
  report.line(heading);
  std::string columns = name("");
  for (std::size_t i = 0; i < matches.front().under.size(); ++i)
    columns += formatted("  %6s %6s %6s", "dE00", "dEab", "M");
  report.line(columns);
  for (const PaintMatch& match : matches) {
    std::string line = name(match.name);
    for (std::size_t i = 0; i < match.under.size(); ++i)
      line += formatted("  %6.2f %6.2f %6.2f", match.under[i].de00, match.under[i].deab,
                        match.index[i].de00);
    report.line(line);
  }
}

/// A line for each candidate under each light.
std::string csv_of(const std::vector<PaintMatch>& matches) {
  std::string text = "candidate,light,de00,deab,metamerism_de00,metamerism_deab\n";
  for (const PaintMatch& match : matches)
    for (std::size_t i = 0; i < match.under.size(); ++i)
      text += client::csv_field(match.name) + "," + client::csv_field(match.under[i].light) +
              formatted(",%.6g,%.6g,%.6g,%.6g\n", match.under[i].de00, match.under[i].deab,
                        match.index[i].de00, match.index[i].deab);
  return text;
}

Result<void> write_match(const std::vector<PaintMatch>& matches, const std::string& file) {
  if (is_csv(file)) return write_text_file(file, csv_of(matches));
  return client::swatches(matches).and_then([&](const Image& image) -> Result<void> {
    const auto written = write_image(image, file, false, {});
    return written ? Result<void>() : tl::unexpected(written.error());
  });
}

ExitCode write_matches(const std::vector<PaintMatch>& matches,
                       const std::vector<std::string>& files, Report& report) {
  for (const std::string& file : files) {
    if (const auto written = write_match(matches, file); !written) {
      report.problem(written.error(), {});
      return ExitCode::other;
    }
    report.document()["files"].push_back(file);
    report.line(file);
  }
  return ExitCode::done;
}

ExitCode match(const MatchOptions& options, Report& report) {
  const auto observer = load_observer(options.input.observer, report);
  if (!observer) return ExitCode::bad_input;
  const auto paints = load_paints(options, *observer, report);
  if (!paints) return ExitCode::bad_input;
  const auto matches = client::match_paints(paints->reference.spectrum(), paints->candidates,
                                            paints->lights, *observer);
  if (!matches) {
    report.problem(matches.error(), {});
    return ExitCode::bad_input;
  }
  const PaintMatch& best = client::nearest(*matches);
  Json& document = report.document();
  document["reference"] = paints->reference.label;
  document["observer"] = observer->name();
  for (const PaintMatch& match : *matches) document["candidates"].push_back(json_of(match));
  document["nearest"] = best.name;
  print_table(*matches, report);
  if (paints->lights.size() > 1)
    report.line("M: the metamerism index of dE00 against " + paints->lights.front().name +
                "; --json and .csv have that of dEab (ISO 18314-4), too");
  report.line(formatted("%s is nearest to %s: at most dE00 %.2f, under %s", best.name.c_str(),
                        paints->reference.label.c_str(), best.worst_de00(),
                        best.under[best.worst].light.c_str()));
  const ExitCode written = write_matches(*matches, options.outputs, report);
  if (written != ExitCode::done) return written;
  if (!options.max || best.worst_de00() <= *options.max) return ExitCode::done;
  report.error(formatted("none keeps to dE00 %g", *options.max));
  return ExitCode::other;
}

ExitCode run(const MatchOptions& options) {
  Report report(options.input.json);
  if (options.input.files.size() < 2)
    return refuse("a reference and a candidate are needed", report);
  for (const std::string& file : options.outputs)
    if (!is_csv(file) && std::filesystem::path(file).extension() != ".png")
      return refuse("--output: " + quoted(file) + " ends neither in .png nor in .csv", report);
  return report.finish(match(options, report));
}

void declare(MatchOptions& values, Options& options) {
  declare_spectra(values.input, options);
  options.front().meaning =
      "the reference, then the candidates: files (FILE#ENTRY: one of several) or test colours";
  declare_observer(values.input, options);
  options.push_back({.names = "--under",
                     .target = &values.lights,
                     .meaning = "the lights; M, the metamerism index of ΔE00, is 0 under the first",
                     .type = "LIGHT,…",
                     .shows_default = true,
                     .separator = ','});
  options.push_back({.names = "--max",
                     .target = &values.max,
                     .meaning = "exit with 1 where the nearest differs by more ΔE00 under a light",
                     .sign = Option::Sign::not_negative});
  options.push_back({.names = "-o,--output",
                     .target = &values.outputs,
                     .meaning = "a .png of swatches: lights across, candidates down, the reference "
                                "at the left of each; or a .csv; may be given several times"});
}

}  // namespace

Command commands::spectra_compare() {
  return make_command<MatchOptions>("spectra compare", "which paint matches another, by light",
                                    declare, run);
}

}  // namespace metamer::cli
