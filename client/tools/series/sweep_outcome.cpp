// What became of a sweep's rows.
#include <algorithm>
#include <utility>

#include "client/tools/pictures/comparison.h"
#include "client/tools/series/sweep.h"
#include "client/tools/text/csv.h"
#include "client/tools/tradeoff/tradeoff_steps.h"
#include "common/image/compare.h"

namespace metamer::client {
namespace {

/// The options by which two pictures are shown that are not the same, as the command line has them.
std::vector<std::string> unlike(const v1::Development& a, const v1::Development& b) {
  std::vector<std::string> names;
  if (a.has_adaptation() != b.has_adaptation() || a.adaptation() != b.adaptation())
    names.emplace_back("adapt");
  if (a.rgb_space() != b.rgb_space() ||
      a.primaries().SerializeAsString() != b.primaries().SerializeAsString())
    names.emplace_back("rgb");
  if (a.exposure() != b.exposure() || a.white_luminance() != b.white_luminance())
    names.emplace_back("exposure");
  if (a.linear() != b.linear()) names.emplace_back("linear");
  return names;
}

std::string error_fields(const SweepOutcome& one) {
  if (!one.error) return std::string(12, ',');
  const ErrorStatistics& error = *one.error;
  std::string text;
  for (const double number :
       {error.mean, error.median, error.percentile_95, error.percentile_99, error.maximum})
    text += number_text(number) + ",";
  for (const std::size_t count : {error.at % one.width, error.at / one.width, error.not_finite})
    text += std::to_string(count) + ",";
  for (std::size_t i = 0; i < 3; ++i)
    text += (one.white ? number_text(one.white->xyz[i]) : "") + ",";
  std::string names;
  for (const std::string& name : one.not_in_error) names += (names.empty() ? "" : " ") + name;
  return text + csv_field(names) + ",";
}

std::string accuracy_fields(const SweepOutcome& one) {
  if (!one.accuracy) return std::string(4, ',');
  const v1::ColorError& error = one.accuracy->error();
  return number_text(error.mean()) + "," + number_text(error.percentile_95()) + "," +
         number_text(error.maximum()) + "," + (one.accuracy->kept() ? "1," : "0,");
}

}  // namespace

double SweepOutcome::cpu_seconds() const {
  double sum = 0;
  for (const v1::PhaseTime& phase : record.phase()) sum += phase.cpu_seconds();
  return sum;
}

std::string SweepOutcome::machines() const {
  std::string text;
  for (const v1::MachineRecord& machine : record.machine())
    if (!machine.name().empty()) text += (text.empty() ? "" : " ") + machine.name();
  return text;
}

void SweepComparison::set_reference(Image picture, const v1::Plan& plan, const v1::Scene& scene) {
  reference_ = std::move(picture);
  const std::optional<Xyz> lit = lit_white(plan, scene);
  white_ = lit ? White{"of the dominant light", *lit} : srgb_white();
  development_ = plan.development();
  for (const auto& [outcome, waiting] : std::exchange(waiting_, {}))
    compare_with(*outcome, waiting);
}

void SweepComparison::give_up(const std::string& why) {
  none_ = why;
  for (const auto& [outcome, waiting] : std::exchange(waiting_, {})) outcome->uncompared = none_;
}

void SweepComparison::add(SweepOutcome& outcome, Image picture) {
  if (reference_)
    compare_with(outcome, picture);
  else if (none_.empty())
    waiting_.emplace_back(&outcome, std::move(picture));
  else
    outcome.uncompared = none_;
}

void SweepComparison::compare_with(SweepOutcome& outcome, const Image& picture) const {
  auto difference = compare(*reference_, picture, Metric::de00, white_.xyz);
  if (!difference) {
    outcome.uncompared = difference.error().message;
    return;
  }
  outcome.error = std::move(difference->statistics);
  outcome.white = white_;
  outcome.not_in_error = unlike(development_, outcome.development);
}

std::string sweep_csv(const std::vector<SweepAxis>& axes,
                      const std::vector<SweepOutcome>& outcomes) {
  std::string text;
  for (const SweepAxis& axis : axes) text += csv_field(axis.name) + ",";
  text +=
      "render_seconds,prepare_seconds,total_seconds,cpu_seconds,rays,mean,median,percentile_95,"
      "percentile_99,maximum,x,y,not_finite,white_x,white_y,white_z,not_in_error,verified_mean,"
      "verified_percentile_95,verified_maximum,kept,reference,machines,job,failure\r\n";
  for (const SweepOutcome& one : outcomes) {
    for (const std::string& value : one.row.values) text += csv_field(value) + ",";
    if (one.failure.empty()) {
      const v1::Timing& timing = one.timing;
      const double prepare =
          timing.compile() + timing.acceleration() + timing.pilot() + timing.prepare();
      for (const double number : {timing.render(), prepare, timing.total(), one.cpu_seconds()})
        text += number_text(number) + ",";
      text += std::to_string(timing.rays()) + ",";
    } else {
      text += ",,,,,";
    }
    text += error_fields(one) + accuracy_fields(one);
    text += std::string(one.is_reference ? "1" : "0") + "," + csv_field(one.machines()) + ",";
    text += csv_field(one.job.number > 0 ? to_text(one.job) : "") + ",";
    text += csv_field(one.failure.empty() ? one.uncompared : one.failure) + "\r\n";
  }
  return text;
}

}  // namespace metamer::client
