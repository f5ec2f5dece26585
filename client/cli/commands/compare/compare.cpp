// Two pictures, colour by colour. No server is asked.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <tuple>

#include "client/cli/commands.h"
#include "client/cli/commands/compare/compare_json.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/tools/pictures/comparison.h"
#include "client/tools/spectra/spectra_files.h"
#include "client/tools/text/formatted.h"
#include "common/color/table_weights.h"

namespace metamer::cli {
namespace {

using client::Pixel;
using client::White;

/// Two picture files; no server.
struct CompareOptions {
  bool json = false;
  std::string a, b;
  std::string metric = "de00";             ///< "de00", "deuv", "deab"
  std::optional<double> max;               ///< More than this anywhere is a failure.
  std::string output;                      ///< A .png of the differences; empty: none.
  std::optional<double> scale;             ///< The difference that is drawn white.
  std::string white;                       ///< "0.95,1,1.09" or "D50"
  std::string under;                       ///< What lights reflectances: "F11"
  std::string observer = "cie-1931-2deg";  ///< or "cie-1964-10deg", or a file
  std::string weights = "lines";           ///< or "astm": what reflectances are between bands
  std::vector<std::string> part, layer;    ///< Of an .exr: of both, or one of each.
};

Metric metric_of(const std::string& word) {
  return word == "deuv" ? Metric::deuv : word == "deab" ? Metric::deab : Metric::de00;
}

/// "0.95,1,1.09"; nothing when it is not three numbers.
std::optional<Xyz> parse_xyz(std::string_view text) {
  Xyz xyz{};
  const char *next = text.data(), *const end = text.data() + text.size();
  for (std::size_t c = 0; c < 3; ++c) {
    if (c > 0 && (next == end || *next++ != ',')) return std::nullopt;
    const auto [after, error] = std::from_chars(next, end, xyz[c]);
    if (error != std::errc{}) return std::nullopt;
    next = after;
  }
  return next == end ? std::optional(xyz) : std::nullopt;
}

/// A light as white; nothing where it is none, which is said.
std::optional<White> white_of_light(const std::string& option, const std::string& word,
                                    const Spectrum& light, const Observer& observer,
                                    Report& report) {
  auto white = client::white_under(word, light, observer);
  if (white) return std::move(*white);
  report.error(option + ": " + white.error().message);
  return std::nullopt;
}

/// What --white says; else the light of --under; else sRGB's white. Nothing where that is none,
/// which is said.
std::optional<White> find_white(const CompareOptions& options, const Observer& observer,
                                const Spectrum& under, Report& report) {
  if (options.white.find(',') != std::string::npos) {
    const std::optional<Xyz> xyz = parse_xyz(options.white);
    const bool finite = xyz && std::all_of(xyz->begin(), xyz->end(), [](double value) {
                          return value > 0 && std::isfinite(value);
                        });
    if (finite) return White{"X,Y,Z", *xyz};
    report.error(xyz ? "--white: X, Y and Z must be finite and above 0"
                     : "--white: " + quoted(options.white) + " is not X,Y,Z, such as 0.95,1,1.09");
    return std::nullopt;
  }
  if (!options.white.empty()) {
    const auto light = load_light(options.white, "--white", observer, report);
    if (!light) return std::nullopt;
    return white_of_light("--white", options.white, *light, observer, report);
  }
  if (options.under.empty()) return client::srgb_white();
  return white_of_light("--under", options.under, under, observer, report);
}

void print_difference(const Difference& difference, Report& report) {
  const ErrorStatistics& all = difference.statistics;
  if (all.count == 0) {
    report.line("no pixel to compare");
    return;
  }
  report.line(formatted("mean %.4g, median %.4g, 95th percentile %.4g, 99th percentile %.4g",
                        all.mean, all.median, all.percentile_95, all.percentile_99));
  const Pixel at = client::pixel_at(all.at, difference.width);
  report.line(formatted("maximum %.4g at (%zu, %zu)", all.maximum, at.x, at.y));
}

/// Says where the first pixel that is not a number stands, and in which picture.
void note_not_finite(const Difference& difference, const CompareOptions& options, const Image& a,
                     Report& report) {
  const auto first = client::first_not_finite(difference, a);
  if (!first) return;
  const std::size_t count = difference.statistics.not_finite;
  Problem note;
  note.file = first->picture == 0 ? options.a : options.b;
  note.message = std::to_string(count) +
                 (count == 1 ? " pixel has no finite colour in one of the pictures"
                             : " pixels have no finite colour in one of the pictures") +
                 formatted(", the first at (%zu, %zu) of this one", first->pixel.x, first->pixel.y);
  report.note(note);
}

ExitCode write_difference(const Difference& difference, const CompareOptions& options,
                          Report& report) {
  namespace fs = std::filesystem;
  const std::string title =
      fs::path(options.a).filename().string() + " and " + fs::path(options.b).filename().string();
  const auto written =
      false_color(difference, metric_of(options.metric), options.scale.value_or(0), title)
          .and_then(
              [&](const Image& image) { return write_image(image, options.output, false, {}); });
  if (!written) {
    report.problem(written.error(), {});
    return ExitCode::other;
  }
  report.document()["files"].push_back(options.output);
  report.line(options.output);
  return ExitCode::done;
}

/// Whether the difference keeps to the limit; says why not.
ExitCode judge(const Difference& difference, const CompareOptions& options, Report& report) {
  if (!options.max) return ExitCode::done;
  const ErrorStatistics& all = difference.statistics;
  const bool over = client::is_over(all, *options.max);
  report.document()["limit"] = *options.max;
  report.document()["over"] = over;
  if (all.maximum > *options.max)
    report.error(formatted("the maximum, %.4g, is above the limit, %g", all.maximum, *options.max));
  if (all.not_finite > 0) report.error("pixels without a finite colour keep to no limit");
  return over ? ExitCode::other : ExitCode::done;
}

/// What --part and --layer say of each picture.
Result<std::array<PictureChoice, 2>> choices_of(const CompareOptions& options) {
  std::array<PictureChoice, 2> choices;
  if (options.part.size() > 2) return problem("--part: there are two pictures");
  if (options.layer.size() > 2) return problem("--layer: there are two pictures");
  for (std::size_t i = 0; i < 2; ++i) {
    if (!options.part.empty()) choices[i].part = options.part[std::min(i, options.part.size() - 1)];
    if (!options.layer.empty())
      choices[i].layer = options.layer[std::min(i, options.layer.size() - 1)];
  }
  return choices;
}

/// What is to be said of the pictures as they were read; false: that is an error.
bool check_pictures(const client::PicturePair& pictures, const CompareOptions& options,
                    Report& report) {
  for (const auto& [file, picture] :
       {std::pair(options.a, &pictures[0]), std::pair(options.b, &pictures[1])})
    for (const std::string& note : picture->notes)
      report.note({.field = {}, .file = file, .message = note});
  if (!options.under.empty() && !pictures[0].lit && !pictures[1].lit)
    report.error("--under: neither picture is a reflectance");
  else if (!(options.part.empty() && options.layer.empty()) && !pictures[0].chosen &&
           !pictures[1].chosen)
    report.error("--part, --layer: neither picture has any");
  else if (const auto same = client::same_units(pictures); !same)
    report.error(same.error().message);
  else
    return true;
  return false;
}

/// Both pictures; nothing when one can't be read, which is said.
std::optional<client::PicturePair> read_both(const CompareOptions& options,
                                             const Observer& observer, const Spectrum& under,
                                             Report& report) {
  const Viewing viewing{.observer = observer,
                        .under = options.under.empty() ? nullptr : &under,
                        .weights = *find_table_weights(options.weights)};
  const auto choices = choices_of(options);
  if (!choices) {
    report.error(choices.error().message);
    return std::nullopt;
  }
  auto pictures = client::read_pair({options.a, options.b}, viewing, *choices);
  if (!pictures) {
    for (const Problem& problem : pictures.error()) report.problem(problem, {});
    return std::nullopt;
  }
  if (!check_pictures(*pictures, options, report)) return std::nullopt;
  return std::move(*pictures);
}

ExitCode compare_with(const CompareOptions& options, Report& report) {
  const auto observer = load_observer(options.observer, report);
  if (!observer) return ExitCode::bad_input;
  std::optional<Spectrum> under;
  if (!options.under.empty()) under = load_light(options.under, "--under", *observer, report);
  if (!options.under.empty() && !under) return ExitCode::bad_input;
  if (under && !(metamer::white_of(*under, *observer)[1] > 0)) {
    report.error("--under: " + quoted(options.under) +
                 " stays dark: the observer sees nothing of it");
    return ExitCode::bad_input;
  }
  const auto white = find_white(options, *observer, under.value_or(Spectrum{}), report);
  if (!white) return ExitCode::bad_input;
  const auto pictures = read_both(options, *observer, under.value_or(Spectrum{}), report);
  if (!pictures) return ExitCode::bad_input;
  const auto& [a, b] = *pictures;
  const Metric metric = metric_of(options.metric);
  const auto difference = metamer::compare(a.image, b.image, metric, white->xyz);
  if (!difference) {
    report.problem(difference.error(), {});
    return ExitCode::bad_input;
  }

  Json& document = report.document();
  document["metric"] = options.metric;
  document["white"] = {{"name", white->name}, {"xyz", white->xyz}};
  document["observer"] = observer->name();
  for (const auto& [name, file, what] :
       {std::tuple("a", options.a, a.what), std::tuple("b", options.b, b.what)}) {
    document[name] = {{"file", file}, {"what", what}};
    report.line(file + ": " + what);
  }
  document["difference"] = statistics_json(difference->statistics, difference->width);
  report.line(formatted("%s, white %s: X %.4f Y %.4f Z %.4f", name_of(metric), white->name.c_str(),
                        white->xyz[0], white->xyz[1], white->xyz[2]));
  print_difference(*difference, report);
  note_not_finite(*difference, options, a.image, report);
  if (!options.output.empty()) {
    const ExitCode code = write_difference(*difference, options, report);
    if (code != ExitCode::done) return code;
  }
  return judge(*difference, options, report);
}

ExitCode run(const CompareOptions& options) {
  Report report(options.json);
  const std::string& file = options.output;
  if (!file.empty() && std::filesystem::path(file).extension() != ".png") {
    report.error("--output: " + quoted(file) + " does not end in .png");
    return report.finish(ExitCode::bad_input);
  }
  return report.finish(compare_with(options, report));
}

void declare(CompareOptions& values, Options& options) {
  options.push_back({.names = "a",
                     .target = &values.a,
                     .meaning = "a .png, or an .exr with X Y Z, RGB or spectra",
                     .required = true});
  options.push_back({.names = "b",
                     .target = &values.b,
                     .meaning = "another, of the same size",
                     .required = true});
  options.push_back({.names = "--metric",
                     .target = &values.metric,
                     .meaning = "ΔE00, ΔE*uv or ΔE*ab",
                     .shows_default = true,
                     .choices = {"de00", "deuv", "deab"}});
  options.push_back({.names = "--max",
                     .target = &values.max,
                     .meaning = "exit with 1 where a pixel differs by more",
                     .sign = Option::Sign::not_negative});
  options.push_back({.names = "-o,--output",
                     .target = &values.output,
                     .meaning = "a .png of the differences, with a legend"});
  options.push_back(
      {.names = "--scale",
       .target = &values.scale,
       .meaning = "the difference that is drawn white; else the 99th percentile, rounded up",
       .sign = Option::Sign::positive});
  options.push_back(
      {.names = "--white",
       .target = &values.white,
       .meaning = "what looks white: X,Y,Z or a light as --under takes it; else that, else D65",
       .type = "WHITE"});
  options.push_back({.names = "--under",
                     .target = &values.under,
                     .meaning = std::string("the light of reflectances (T.): ") + light_words,
                     .type = "ILLUMINANT"});
  for (const auto& [name, target] :
       {std::pair("--part", &values.part), std::pair("--layer", &values.layer)})
    options.push_back({.names = name,
                       .target = target,
                       .meaning = "of an .exr that has several; twice: of a, of b",
                       .type = "NAME"});
  options.push_back(
      {.names = "--observer",
       .target = &values.observer,
       .meaning = std::string("who sees spectra and illuminants: ") + observer_meaning,
       .shows_default = true});
  declare_weights(values.weights, options);
  declare_json(values.json, options);
}

}  // namespace

Command commands::compare() {
  return make_command<CompareOptions>("compare", "how far two pictures are apart, as people see it",
                                      declare, run);
}

}  // namespace metamer::cli
