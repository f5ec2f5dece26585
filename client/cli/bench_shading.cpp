// Table 4.5-2 of the source, for every model: what point sampling costs per vertex and per pixel.

#include <array>
#include <cstdio>

#include "client/cli/bench_run.h"
#include "client/cli/commands.h"

namespace metamer::cli {
namespace {

constexpr std::array counts = {7, 16, 61, 301};  ///< Of wavelengths.

/// A line of the table: rgb, then each count in one form or two.
struct Row {
  const models::Entry* model;
  v1::Shading shading;
};

const char* where(v1::Shading shading) { return shading == v1::GOURAUD ? "vertex" : "pixel"; }

std::vector<Row> all_rows() {
  std::vector<Row> rows;
  for (const models::Entry& model : models::registry(models::Kind::model))
    for (const v1::Shading shading : {v1::GOURAUD, v1::PHONG}) rows.push_back({&model, shading});
  return rows;
}

/// The cases of all rows, one row after the other.
std::vector<BenchCase> all_cases(bool multi_pass) {
  std::vector<BenchCase> cases;
  for (const Row& row : all_rows()) {
    cases.push_back(shading_case(*row.model, row.shading, 0, false));
    for (const bool passes : {false, true})
      for (const int count : counts)
        if (multi_pass || !passes)
          cases.push_back(shading_case(*row.model, row.shading, count, passes));
  }
  return cases;
}

void print_shading(const std::vector<BenchCase>&, const std::vector<Measured>& measured,
                   Report& report) {
  const std::vector<Row> rows = all_rows();
  const std::size_t columns = measured.size() / rows.size();
  std::string head = "model            per         rgb";
  for (std::size_t column = 1; column < columns; ++column) {
    char text[32];
    std::snprintf(text, sizeof text, " %7d%c", counts[(column - 1) % counts.size()],
                  column > counts.size() ? '*' : ' ');
    head += text;
  }
  report.line(head);
  Json& document = report.document()["rows"] = Json::array();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Measured* const row = &measured[i * columns];
    char text[64];
    std::snprintf(text, sizeof text, "%-16s %-6s %6.1f ms", rows[i].model->name,
                  where(rows[i].shading), 1000 * median(row[0].seconds));
    std::string line = text;
    Json one = {{"model", rows[i].model->name},
                {"per", where(rows[i].shading)},
                {"rgb", median(row[0].seconds)},
                {"point", Json::object()},
                {"multi_pass", Json::object()}};
    for (std::size_t column = 1; column < columns; ++column) {
      const double ratio = median(relative(row[column], row[0]));
      std::snprintf(text, sizeof text, " %7.2f ", ratio);
      line += text;
      one[column > counts.size() ? "multi_pass" : "point"]
         [std::to_string(counts[(column - 1) % counts.size()])] = ratio;
    }
    report.line(line);
    document.push_back(std::move(one));
  }
}

}  // namespace

ExitCode bench_shading(const BenchOptions& options) {
  return run_bench(options, all_cases(options.overrides.backend == "gl"),
                   "The time of so many wavelengths over that of rgb; *: four a pass.",
                   print_shading);
}

}  // namespace metamer::cli
