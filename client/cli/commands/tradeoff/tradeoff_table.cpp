// What a trade came to: for people, for programs.
#include <optional>

#include "client/cli/commands/compare/compare_json.h"
#include "client/cli/commands/tradeoff/tradeoff_texts.h"
#include "client/tools/text/formatted.h"

namespace metamer::cli {
using client::Tradeoff;
using client::TradeoffRow;

std::vector<std::string> tradeoff_table(const Tradeoff& tradeoff) {
  std::vector<std::string> lines = {formatted("%-10s %-19s %9s %8s %9s %9s %9s", "method",
                                              "parameters", "seconds", "/ rgb", "mean", "95 %",
                                              "max")};
  const std::optional<double> rgb = client::rgb_seconds(tradeoff);
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

Json tradeoff_json(const Tradeoff& tradeoff) {
  Json rows = Json::array();
  const std::optional<double> rgb = client::rgb_seconds(tradeoff);
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
