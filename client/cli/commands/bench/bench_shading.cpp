// Table 4.5-2 of the source, for every model: what point sampling costs per vertex and per pixel.

#include <algorithm>
#include <cstdio>
#include <set>

#include "client/cli/commands.h"
#include "client/cli/commands/bench/bench_run.h"
#include "client/cli/overrides.h"

namespace metamer::cli {
namespace {

struct BenchShadingOptions {
  BenchOptions bench;
  std::vector<std::string> models;                    ///< Empty: all.
  std::vector<std::uint32_t> counts{7, 16, 61, 301};  ///< Of wavelengths, 2 or more.
};

/// What is measured: by rgb first, then by each number of wavelengths in one form or two.
class ShadingTable {
 public:
  explicit ShadingTable(const BenchShadingOptions& options)
      : models_(options.models), counts_(options.counts.begin(), options.counts.end()) {
    if (options.bench.overrides.backend == "gl") forms_ = {false, true};
  }

  /// A line of the table each.
  std::vector<std::vector<BenchCase>> groups() const {
    std::vector<std::vector<BenchCase>> groups;
    for (const models::Entry& model : models::registry(models::Kind::model)) {
      if (!wanted(model)) continue;
      for (const v1::Shading shading : {v1::GOURAUD, v1::PHONG})
        groups.push_back(line_of(model, shading));
    }
    return groups;
  }

  std::string head() const {
    std::string head = "model            per         rgb";
    for (const bool multi_pass : forms_)
      for (const std::uint32_t count : counts_) {
        char text[32];
        std::snprintf(text, sizeof text, " %7u%c", count, multi_pass ? '*' : ' ');
        head += text;
      }
    return head;
  }

  void print(const std::vector<BenchCase>& cases, const std::vector<Measured>& measured,
             Report& report) const {
    const bool vertex = cases[0].scene.settings().shading() == v1::GOURAUD;
    const double rgb = median(measured[0].seconds);
    Json row = {{"model", cases[0].name},
                {"per", vertex ? "vertex" : "pixel"},
                {"rgb", rgb},
                {"point", Json::object()},
                {"multi_pass", Json::object()}};
    char text[64];
    std::snprintf(text, sizeof text, "%-16s %-6s %6.1f ms", cases[0].name.c_str(),
                  vertex ? "vertex" : "pixel", 1000 * rgb);
    std::string line = text;
    std::size_t column = 1;
    for (const bool multi_pass : forms_)
      for (const std::uint32_t count : counts_) {
        const double ratio = median(relative(measured[column++], measured[0]));
        std::snprintf(text, sizeof text, " %7.2f ", ratio);
        line += text;
        row[multi_pass ? "multi_pass" : "point"][std::to_string(count)] = ratio;
      }
    report.line(line);
    report.document()["rows"].push_back(std::move(row));
  }

 private:
  bool wanted(const models::Entry& model) const {
    return models_.empty() ||
           std::find(models_.begin(), models_.end(), model.name) != models_.end();
  }

  std::vector<BenchCase> line_of(const models::Entry& model, v1::Shading shading) const {
    std::vector<BenchCase> cases = {shading_case(model, shading, 0, false)};
    for (const bool multi_pass : forms_)
      for (const std::uint32_t count : counts_)
        cases.push_back(shading_case(model, shading, count, multi_pass));
    return cases;
  }

  const std::vector<std::string>& models_;  ///< Empty: all.
  const std::set<std::uint32_t> counts_;
  std::vector<bool> forms_ = {false};  ///< Multi-pass or not.
};

ExitCode run(const BenchShadingOptions& options) {
  if (options.bench.overrides.shading || choose_a_method(options.bench.overrides))
    return refuse_bench(options.bench,
                        "bench shading compares methods per vertex and per pixel: options that "
                        "choose one are not for it");
  const ShadingTable table(options);
  return run_bench(options.bench, table.groups(),
                   {"The time of so many wavelengths over that of rgb; *: four a pass.",
                    table.head(), [&](const auto& cases, const auto& measured, Report& report) {
                      table.print(cases, measured, report);
                    }});
}

void declare(BenchShadingOptions& values, Options& options) {
  std::vector<std::string> names;
  for (const models::Entry& model : models::registry(models::Kind::model))
    names.emplace_back(model.name);
  options.push_back({.names = "--models",
                     .target = &values.models,
                     .meaning = "these alone",
                     .separator = ',',
                     .choices = names});
  options.push_back({.names = "--counts",
                     .target = &values.counts,
                     .meaning = "of wavelengths",
                     .shows_default = true,
                     .separator = ',',
                     .range = {{2, 4001}}});
  declare_bench(values.bench, options);
}

}  // namespace

Command commands::bench_shading() {
  return make_command<BenchShadingOptions>(
      "bench shading", "point sampling next to rgb, with each model per vertex and per pixel",
      declare, run);
}

}  // namespace metamer::cli
