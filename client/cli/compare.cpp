// Two pictures, colour by colour. No server is asked.
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <tuple>

#include "client/cli/commands.h"
#include "client/cli/compare_json.h"
#include "client/cli/print.h"
#include "client/cli/report.h"
#include "common/color/srgb.h"
#include "common/image/compare.h"
#include "common/image/picture_file.h"
#include "common/image/read_xyz.h"

namespace metamer::cli {
namespace {

/// What looks white, and how it is called.
struct White {
  std::string name;
  Xyz xyz;
};

Metric metric_of(const std::string& word) {
  return word == "deuv" ? Metric::deuv : word == "deab" ? Metric::deab : Metric::de00;
}

cie::Observer observer_of(const std::string& word) {
  return word == "cie-1964-10deg" ? cie::Observer::cie_1964_10deg : cie::Observer::cie_1931_2deg;
}

Result<const Spectrum*> find_illuminant(const std::string& option, const std::string& name) {
  if (const Spectrum* found = cie::illuminant(name)) return found;
  return problem(option + ": no illuminant named " + quoted(name) +
                 did_you_mean(name, cie::illuminant_names()));
}

/// X Y Z of an illuminant at Y = 1, by 1 nm.
Xyz white_of(const Spectrum& illuminant, cie::Observer observer) {
  const Wavelengths wavelengths = observer_wavelengths();
  const ObserverWeights weights = observer_weights(observer, wavelengths);
  Xyz xyz = to_xyz(weights, resample(illuminant, wavelengths.nm(), Outside::zero).values);
  for (const double y = xyz[1]; double& value : xyz) value /= y;
  return xyz;
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

/// What --white says; else the light of --under; else sRGB's white.
Result<White> find_white(const CompareOptions& options) {
  const cie::Observer observer = observer_of(options.observer);
  if (options.white.find(',') != std::string::npos) {
    const std::optional<Xyz> xyz = parse_xyz(options.white);
    if (!xyz)
      return problem("--white: " + quoted(options.white) + " is not X,Y,Z, such as 0.95,1,1.09");
    for (const double value : *xyz)
      if (!(value > 0) || !std::isfinite(value))
        return problem("--white: X, Y and Z must be finite and above 0");
    return White{"X,Y,Z", *xyz};
  }
  const std::string& name = options.white.empty() ? options.under : options.white;
  if (name.empty()) return White{"D65 (sRGB)", srgb::to_xyz({1, 1, 1})};
  return find_illuminant("--white", name).transform([&](const Spectrum* found) {
    return White{name, white_of(*found, observer)};
  });
}

void print_difference(const Difference& difference, Report& report) {
  const ErrorStatistics& all = difference.statistics;
  const auto width = static_cast<std::size_t>(difference.width);
  if (all.count == 0) {
    report.line("no pixel to compare");
    return;
  }
  report.line(print("mean %.4g, median %.4g, 95th percentile %.4g, 99th percentile %.4g", all.mean,
                    all.median, all.percentile_95, all.percentile_99));
  report.line(print("maximum %.4g at (%zu, %zu)", all.maximum, all.at % width, all.at / width));
}

/// Says where the first pixel that is not a number stands, and in which picture.
void note_not_finite(const Difference& difference, const CompareOptions& options, const Image& a,
                     Report& report) {
  const ErrorStatistics& all = difference.statistics;
  if (all.not_finite == 0) return;
  const auto width = static_cast<std::size_t>(difference.width);
  const float* pixel = a.pixels.data() + 3 * all.first_not_finite;
  bool in_a = false;
  for (int c = 0; c < 3; ++c) in_a = in_a || !std::isfinite(pixel[c]);
  Problem note;
  note.file = in_a ? options.a : options.b;
  note.message = std::to_string(all.not_finite) +
                 (all.not_finite == 1 ? " pixel has no finite colour in one of the pictures"
                                      : " pixels have no finite colour in one of the pictures") +
                 print(", the first at (%zu, %zu) of this one", all.first_not_finite % width,
                       all.first_not_finite / width);
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
  const bool over = all.maximum > *options.max || all.not_finite > 0;
  report.document()["limit"] = *options.max;
  report.document()["over"] = over;
  if (all.maximum > *options.max)
    report.error(print("the maximum, %.4g, is above the limit, %g", all.maximum, *options.max));
  if (all.not_finite > 0) report.error("pixels without a finite colour keep to no limit");
  return over ? ExitCode::other : ExitCode::done;
}

/// Emissions compare in one unit; a file that names none is taken at its word. Says why not.
bool same_units(const XyzPicture& a, const XyzPicture& b, Report& report) {
  if (a.units == b.units || a.units.empty() || b.units.empty()) return true;
  report.error("the pictures have different units: " + quoted(a.units) + " and " + quoted(b.units));
  return false;
}

/// Both pictures; nothing when one can't be read, which is said.
std::optional<std::array<XyzPicture, 2>> read_both(const CompareOptions& options, Report& report) {
  Viewing viewing{.observer = observer_of(options.observer), .under = nullptr};
  if (!options.under.empty()) {
    const auto under = find_illuminant("--under", options.under);
    if (!under) {
      report.problem(under.error(), {});
      return std::nullopt;
    }
    viewing.under = *under;
  }
  std::array<XyzPicture, 2> pictures;
  bool good = true;
  for (std::size_t i = 0; i < 2; ++i) {
    Result<XyzPicture> read = read_xyz(i == 0 ? options.a : options.b, viewing);
    good = good && read;
    if (read) {
      pictures[i] = std::move(*read);
    } else {
      report.problem(read.error(), {});
    }
  }
  if (!good) return std::nullopt;
  if (viewing.under && !pictures[0].lit && !pictures[1].lit) {
    report.error("--under: neither picture is a reflectance");
    return std::nullopt;
  }
  if (!same_units(pictures[0], pictures[1], report)) return std::nullopt;
  return pictures;
}

ExitCode compare_with(const CompareOptions& options, Report& report) {
  const Result<White> white = find_white(options);
  if (!white) {
    report.problem(white.error(), {});
    return ExitCode::bad_input;
  }
  const auto pictures = read_both(options, report);
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
  document["observer"] = options.observer;
  for (const auto& [name, file, what] :
       {std::tuple("a", options.a, a.what), std::tuple("b", options.b, b.what)}) {
    document[name] = {{"file", file}, {"what", what}};
    report.line(file + ": " + what);
  }
  document["difference"] = statistics_json(difference->statistics, difference->width);
  report.line(print("%s, white %s: X %.4f Y %.4f Z %.4f", name_of(metric), white->name.c_str(),
                    white->xyz[0], white->xyz[1], white->xyz[2]));
  print_difference(*difference, report);
  note_not_finite(*difference, options, a.image, report);
  if (!options.output.empty()) {
    const ExitCode code = write_difference(*difference, options, report);
    if (code != ExitCode::done) return code;
  }
  return judge(*difference, options, report);
}

}  // namespace

Json statistics_json(const ErrorStatistics& all, int width) {
  const auto columns = static_cast<std::size_t>(width);
  const auto place = [&](std::size_t at) { return Json{{"x", at % columns}, {"y", at / columns}}; };
  Json json = {{"pixels", all.count}, {"not_finite", all.not_finite}};
  if (all.not_finite > 0) json["first_not_finite"] = place(all.first_not_finite);
  if (all.count == 0) return json;
  json["mean"] = all.mean;
  json["median"] = all.median;
  json["percentile_95"] = all.percentile_95;
  json["percentile_99"] = all.percentile_99;
  json["maximum"] = all.maximum;
  json["at"] = place(all.at);
  return json;
}

ExitCode compare(const CompareOptions& options) {
  Report report(options.json);
  const std::string& file = options.output;
  if (!file.empty() && std::filesystem::path(file).extension() != ".png") {
    report.error("--output: " + quoted(file) + " does not end in .png");
    return report.finish(ExitCode::bad_input);
  }
  const bool drawn = !file.empty();
  if (drawn || format_of(options.a) == "png" || format_of(options.b) == "png") {
    if (const auto loaded = load_file_formats(); !loaded) {
      report.problem(loaded.error(), {});
      return report.finish(ExitCode::other);
    }
  }
  return report.finish(compare_with(options, report));
}

}  // namespace metamer::cli
