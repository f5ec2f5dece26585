#include "client/cli/commands/series/sweep_plan.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "client/cli/option_value.h"
#include "client/cli/overrides.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;
using client::SweepAxis;
using client::SweepRow;

/// The options of a row: its own in place of the others.
Result<Overrides> overrides_of(const Sweep& sweep, const SweepRow& row) {
  Overrides overrides = sweep.options.overrides;
  Options options;
  declare_overrides(overrides, options);
  for (std::size_t axis = 0; axis < sweep.axes.size(); ++axis)
    for (const Option& option : options)
      if (option.names == "--" + sweep.axes[axis].name)
        if (auto set = set_value(option, row.values[axis]); !set)
          return problem(option.names + ": " + set.error().message);
  return overrides;
}

/// Whether the command line has a value for it. One of a list goes with others.
bool is_given(const Option& option) {
  return std::visit(
      [](const auto* target) {
        if constexpr (std::is_same_v<decltype(target), const bool*>)
          return *target;
        else if constexpr (requires { target->has_value(); })
          return target->has_value();
        else
          return false;
      },
      option.target);
}

/// Whether each axis is an option that changes a scene, and but for lists of them neither given
/// beside it nor another axis.
Result<void> check_axes(const std::vector<SweepAxis>& axes, Overrides given) {
  Options options;
  declare_overrides(given, options);
  std::vector<std::string> names, taken;
  for (const Option& option : options) names.push_back(option.names.substr(2));
  for (const SweepAxis& axis : axes) {
    const auto named = std::find(names.begin(), names.end(), axis.name);
    if (named == names.end())
      return tl::unexpected(
          unknown_name("no option of a scene is called " + quoted(axis.name), axis.name, names));
    const Option& option = options[static_cast<std::size_t>(named - names.begin())];
    const bool is_list = std::holds_alternative<std::vector<std::string>*>(option.target);
    if (!is_list && std::find(taken.begin(), taken.end(), axis.name) != taken.end())
      return problem(quoted(axis.name) + " is varied twice");
    if (is_given(option)) return problem(quoted(axis.name) + " is varied and given");
    taken.push_back(axis.name);
  }
  return {};
}

}  // namespace

std::optional<Sweep> understand(const SweepOptions& options, Report& report) {
  Sweep sweep{.options = options, .axes = {}, .rows = {}, .order = {}, .pictures = {}};
  const auto refuse = [&](const char* option, const std::string& why) {
    report.error(std::string(option) + ": " + why);
    return std::nullopt;
  };
  for (const std::string& text : options.vary) {
    auto axis = client::parse_axis(text);
    if (!axis) return refuse("--vary", axis.error().message);
    sweep.axes.push_back(std::move(*axis));
  }
  if (auto checked = check_axes(sweep.axes, options.overrides); !checked)
    return refuse("--vary", checked.error().message);
  auto rows = client::sweep_rows(sweep.axes);
  if (!rows) return refuse("--vary", rows.error().message);
  sweep.rows = std::move(*rows);
  const auto reference = client::find_row(sweep.axes, sweep.rows, options.reference);
  if (!reference) return refuse("--reference", reference.error().message);
  sweep.order.resize(sweep.rows.size());
  std::iota(sweep.order.begin(), sweep.order.end(), std::size_t{0});
  std::rotate(sweep.order.begin(), sweep.order.begin() + static_cast<std::ptrdiff_t>(*reference),
              sweep.order.begin() + static_cast<std::ptrdiff_t>(*reference) + 1);
  std::vector<std::uint32_t> numbers(sweep.rows.size());
  std::iota(numbers.begin(), numbers.end(), 1u);
  auto pictures =
      SeriesOutput::read(options.pictures, "--pictures", options.sheet, numbers, report);
  if (!pictures) return std::nullopt;
  sweep.pictures = std::move(*pictures);
  std::error_code error;
  if (!options.folder.empty()) fs::create_directories(options.folder, error);
  if (!options.folder.empty() && !fs::is_directory(options.folder))
    return refuse("--output",
                  "can't make the folder " + quoted(options.folder) + ": " + error.message());
  return sweep;
}

Result<CheckedScene> SweepScenes::scene(std::size_t row) {
  const auto overrides = overrides_of(sweep_, sweep_.rows[row]);
  if (!overrides) return tl::unexpected(overrides.error());
  const CheckedScene::Change change = [&](v1::Scene& parsed) { return apply(*overrides, parsed); };
  CheckedScene scene = CheckedScene::read(sweep_.options.scene, digests_, change);
  if (scene.sound()) return scene;
  return tl::unexpected(scene.problems().front());
}

bool SweepScenes::check(Report& report) {
  const std::size_t reference = sweep_.order.front();
  const auto read = scene(reference);
  if (read) return true;
  report.error("the reference, row " + std::to_string(reference + 1) + " (" +
               sweep_.rows[reference].label + "), can't be rendered:");
  report.problem(read.error());
  return false;
}

}  // namespace metamer::cli
