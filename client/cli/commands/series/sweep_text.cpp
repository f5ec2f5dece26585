// What a sweep came to: for people, for programs.
#include "client/cli/commands/series/sweep_text.h"

#include <algorithm>

#include "client/cli/commands/compare/compare_json.h"
#include "client/tools/text/formatted.h"
#include "common/printable.h"

namespace metamer::cli {

using client::formatted;
using client::SweepOutcome;

namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// What holds of all the differences: their reference, their white, what they do not know of.
std::vector<std::string> foot(const std::vector<SweepOutcome>& outcomes) {
  std::vector<std::string> lines, names;
  std::size_t reference = 0;
  const SweepOutcome* compared = nullptr;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i].is_reference) reference = i + 1;
    if (outcomes[i].error && outcomes[i].white) compared = &outcomes[i];
    for (const std::string& name : outcomes[i].not_in_error)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (compared == nullptr) return lines;
  const Xyz& white = compared->white->xyz;
  lines.push_back(formatted("ΔE00 from row %zu, white X %.4g Y %.4g Z %.4g (", reference, white[0],
                            white[1], white[2]) +
                  compared->white->name + ")");
  if (!names.empty())
    lines.push_back("not in ΔE00, as it is how a picture is shown: " + listed(names));
  return lines;
}

std::string accuracy_text(const v1::Accuracy& accuracy) {
  const v1::ColorError& error = accuracy.error();
  return formatted("  verified: mean %.3g, 95 %% %.3g, max %.3g", error.mean(),
                   error.percentile_95(), error.maximum()) +
         (accuracy.kept() ? "" : ", the promise is broken");
}

}  // namespace

std::string sweep_note(const SweepOutcome& outcome) {
  if (!outcome.failure.empty()) return "failed";
  if (outcome.is_reference) return "reference";
  if (!outcome.error) return outcome.uncompared;
  std::string text =
      formatted("dE00 mean %.2f, max %.2f", outcome.error->mean, outcome.error->maximum);
  if (!outcome.not_in_error.empty()) text += " without " + listed(outcome.not_in_error);
  return text;
}

std::vector<std::string> sweep_table(const std::vector<SweepOutcome>& outcomes) {
  std::size_t width = 3;
  for (const SweepOutcome& one : outcomes) width = std::max(width, one.row.label.size());
  const auto first = [&](const std::string& words) {
    return words + std::string(width - std::min(width, words.size()), ' ');
  };
  std::vector<std::string> lines = {
      formatted("%5s  ", "row") + first("") +
      formatted(" %9s %9s %9s %9s %9s %9s", "render s", "CPU s", "Mrays", "mean", "95 %", "max")};
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const SweepOutcome& one = outcomes[i];
    std::string line = formatted("%5zu  ", i + 1) + first(printable(one.row.label)) + ' ';
    if (!one.failure.empty()) {
      lines.push_back(line + "failed: " + one.failure);
      continue;
    }
    line += formatted("%9.4f %9.4f %9.2f ", one.timing.render(), one.cpu_seconds(),
                      static_cast<double>(one.timing.rays()) * 1e-6);
    if (one.error)
      line += formatted("%9.3g %9.3g %9.3g", one.error->mean, one.error->percentile_95,
                        one.error->maximum);
    else
      line += one.is_reference ? "reference" : one.uncompared;
    if (one.accuracy) line += accuracy_text(*one.accuracy);
    lines.push_back(line);
  }
  for (std::string& line_below : foot(outcomes)) lines.push_back(std::move(line_below));
  return lines;
}

Json sweep_json(const std::vector<client::SweepAxis>& axes,
                const std::vector<SweepOutcome>& outcomes) {
  Json rows = Json::array();
  for (const SweepOutcome& one : outcomes) {
    Json values = Json::object();
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      values[axes[axis].name] = one.row.values[axis];
    Json row = {{"label", one.row.label}, {"values", values}, {"reference", one.is_reference}};
    if (one.job.number > 0) row["handle"] = to_text(one.job);
    if (one.failure.empty()) {
      row["timing"] = to_json(one.timing);
      row["record"] = to_json(one.record);
      row["cpu_seconds"] = one.cpu_seconds();
      if (one.error) row["error"] = statistics_json(*one.error, static_cast<int>(one.width));
      if (one.white) row["white"] = {{"name", one.white->name}, {"xyz", one.white->xyz}};
      if (!one.not_in_error.empty()) row["not_in_error"] = one.not_in_error;
      if (one.accuracy) row["accuracy"] = to_json(*one.accuracy);
      if (!one.uncompared.empty()) row["uncompared"] = one.uncompared;
    } else {
      row["failure"] = one.failure;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace metamer::cli
