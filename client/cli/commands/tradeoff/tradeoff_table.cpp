// What a trade came to: for people, for programs.
#include <array>
#include <cstdio>
#include <optional>

#include "client/cli/commands/compare/compare_json.h"
#include "client/cli/commands/tradeoff/tradeoff.h"
#include "client/tools/csv.h"
#include "client/tools/formatted.h"
#include "common/problem.h"

namespace metamer::cli {
namespace {

using client::csv_field;

/// Seconds that the naive rgb took; nothing where it failed.
std::optional<double> rgb_seconds(const Tradeoff& tradeoff) {
  for (const TradeoffRow& row : tradeoff.rows)
    if (row.what.method == "rgb" && row.failure.empty() && row.seconds() > 0) return row.seconds();
  return std::nullopt;
}

}  // namespace

std::vector<std::string> tradeoff_table(const Tradeoff& tradeoff) {
  std::vector<std::string> lines = {formatted("%-10s %-19s %9s %8s %9s %9s %9s", "method",
                                              "parameters", "seconds", "/ rgb", "mean", "95 %",
                                              "max")};
  const std::optional<double> rgb = rgb_seconds(tradeoff);
  for (const TradeoffRow& row : tradeoff.rows) {
    std::string line =
        formatted("%-10s %-19s ", row.what.method.c_str(), row.what.parameters.c_str());
    if (row.failure.empty()) {
      line += formatted("%9.4f ", row.seconds());
      line += rgb ? formatted("%8.3f ", row.seconds() / *rgb) : client::formatted("%8s ", "-");
      line += formatted("%9.3g %9.3g %9.3g%s", row.error.mean, row.error.percentile_95,
                        row.error.maximum, row.front ? "  front" : "");
    } else {
      line += "failed: " + row.failure;
    }
    lines.push_back(line);
  }
  return lines;
}

std::string tradeoff_csv(const Tradeoff& tradeoff) {
  std::string text =
      "method,parameters,prepare_seconds,render_seconds,seconds,relative_to_rgb,mean,median,"
      "percentile_95,percentile_99,maximum,x,y,not_finite,front,failure\r\n";
  const std::optional<double> rgb = rgb_seconds(tradeoff);
  const std::size_t width = tradeoff.plan.width();
  for (const TradeoffRow& row : tradeoff.rows) {
    text += csv_field(row.what.method) + "," + csv_field(row.what.parameters);
    if (row.failure.empty()) {
      for (const double number : {row.prepare, row.render, row.seconds()})
        text += "," + number_text(number);
      text += "," + (rgb ? number_text(row.seconds() / *rgb) : std::string());
      const ErrorStatistics& error = row.error;
      for (const double number :
           {error.mean, error.median, error.percentile_95, error.percentile_99, error.maximum})
        text += "," + number_text(number);
      for (const std::size_t count : {error.at % width, error.at / width, error.not_finite})
        text += "," + std::to_string(count);
      text += std::string(row.front ? ",1" : ",0") + ",";
    } else {
      text += ",,,,,,,,,,,,,0," + csv_field(row.failure);
    }
    text += "\r\n";
  }
  return text;
}

Json tradeoff_json(const Tradeoff& tradeoff) {
  Json rows = Json::array();
  const std::optional<double> rgb = rgb_seconds(tradeoff);
  for (const TradeoffRow& row : tradeoff.rows) {
    Json json = {{"method", row.what.method},
                 {"parameters", row.what.parameters},
                 {"settings", to_json(row.what.settings)}};
    if (row.failure.empty()) {
      json["prepare"] = row.prepare;
      json["render"] = row.render;
      json["seconds"] = row.seconds();
      if (rgb) json["relative_to_rgb"] = row.seconds() / *rgb;
      json["error"] = statistics_json(row.error, static_cast<int>(tradeoff.plan.width()));
      json["front"] = row.front;
      json["difference"] = "diff-" + row.what.stem + ".png";
    } else {
      json["failure"] = row.failure;
    }
    rows.push_back(std::move(json));
  }
  return {
      {"scene", tradeoff.scene},
      {"metric", "de00"},
      {"white", tradeoff.white},
      {"rounds", tradeoff.rounds},
      {"reference", {{"seconds", tradeoff.reference_seconds}, {"plan", to_json(tradeoff.plan)}}},
      {"rows", std::move(rows)}};
}

}  // namespace metamer::cli
