// What became of a sweep's rows.
#include <algorithm>
#include <utility>

#include "client/tools/pictures/comparison.h"
#include "client/tools/series/sweep.h"
#include "client/tools/text/csv.h"
#include "client/tools/tradeoff/tradeoff_steps.h"
#include "common/image/compare.h"

namespace metamer::client {

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
  white_ = lit_white(plan, scene).value_or(srgb_white().xyz);
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
  auto difference = compare(*reference_, picture, Metric::de00, white_);
  if (difference)
    outcome.error = std::move(difference->statistics);
  else
    outcome.uncompared = difference.error().message;
}

std::string sweep_csv(const std::vector<SweepAxis>& axes,
                      const std::vector<SweepOutcome>& outcomes) {
  std::string text;
  for (const SweepAxis& axis : axes) text += csv_field(axis.name) + ",";
  text +=
      "render_seconds,prepare_seconds,total_seconds,cpu_seconds,rays,mean,median,percentile_95,"
      "percentile_99,maximum,x,y,not_finite,reference,machines,job,failure\r\n";
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
    if (one.error) {
      const ErrorStatistics& error = *one.error;
      for (const double number :
           {error.mean, error.median, error.percentile_95, error.percentile_99, error.maximum})
        text += number_text(number) + ",";
      for (const std::size_t count : {error.at % one.width, error.at / one.width, error.not_finite})
        text += std::to_string(count) + ",";
    } else {
      text += ",,,,,,,,";
    }
    text += std::string(one.is_reference ? "1" : "0") + "," + csv_field(one.machines()) + ",";
    text += csv_field(one.job.number > 0 ? to_text(one.job) : "") + ",";
    text += csv_field(one.failure.empty() ? one.uncompared : one.failure) + "\r\n";
  }
  return text;
}

}  // namespace metamer::client
