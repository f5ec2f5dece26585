// One scene with all combinations of some options' values: a table.
#include <filesystem>

#include "client/cli/commands.h"
#include "client/cli/commands/series/follow_series.h"
#include "client/cli/commands/series/series_sheet.h"
#include "client/cli/commands/series/sweep_plan.h"
#include "client/cli/commands/series/sweep_text.h"
#include "client/cli/output/gnuplot.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;
using client::SweepOutcome;

/// The jobs of a sweep, and what comes of them.
class Sweeping {
 public:
  Sweeping(const Sweep& sweep, SweepScenes& scenes, Report& report)
      : sweep_(sweep),
        scenes_(scenes),
        report_(report),
        sheet_(sweep.options.sheet, static_cast<std::uint32_t>(sweep.rows.size())) {
    for (const client::SweepRow& row : sweep.rows) outcomes_.emplace_back().row = row;
    outcomes_[sweep.order.front()].is_reference = true;
  }

  Result<Submission> make(std::uint32_t index) {
    auto scene = scenes_.scene(sweep_.order[index]);
    if (!scene) return tl::unexpected(std::move(scene.error()));
    if (index == 0) reference_scene_ = scene->scene();
    return client::make_submission(scene->scene(), scene->assets(), scene->name(), false);
  }

  void take(SeriesPart part, ProgressView& view) {
    const std::size_t row = sweep_.order[part.index];
    SweepOutcome& outcome = outcomes_[row];
    outcome.failure = part.failure;
    if (part.record) outcome.job = part.record->job;
    const bool done = outcome.failure.empty();
    sheet_.add(static_cast<std::uint32_t>(row), part.label, done ? &*part.record : nullptr);
    if (!done && outcome.is_reference) comparison_.give_up("the reference failed");
    if (!done) return;
    JobRecord& job = *part.record;
    outcome.timing = job.last.finished().timing();
    outcome.record = job.last.finished().record();
    if (job.last.finished().has_accuracy()) outcome.accuracy = job.last.finished().accuracy();
    outcome.development = job.plan->development();
    outcome.width = job.plan->width();
    if (outcome.is_reference)
      comparison_.set_reference(job.film->image(), *job.plan, reference_scene_);
    else
      comparison_.add(outcome, job.film->image());
    view.clear();
    const ExitCode code =
        sweep_.pictures.write(static_cast<std::uint32_t>(row + 1), job, scene_name(), report_);
    if (code != ExitCode::done) written_ = code;
  }

  /// The table, and the files, of whatever rows are done.
  ExitCode report() {
    comparison_.give_up("the reference is not finished");
    for (const std::string& line : sweep_table(outcomes_)) report_.line(line);
    report_.document()["rows"] = sweep_json(sweep_.axes, outcomes_);
    for (std::size_t row = 0; row < outcomes_.size(); ++row)
      sheet_.note(static_cast<std::uint32_t>(row), sweep_note(outcomes_[row]));
    const bool any = std::any_of(outcomes_.begin(), outcomes_.end(),
                                 [](const SweepOutcome& one) { return one.failure.empty(); });
    if (const ExitCode code = any ? sheet_.write(report_) : ExitCode::done; code != ExitCode::done)
      written_ = code;
    if (sweep_.options.folder.empty()) return written_;
    const fs::path folder = sweep_.options.folder;
    const std::string json =
        report_.document()["rows"].dump(2, ' ', false, Json::error_handler_t::replace);
    write(folder / "sweep.csv", client::sweep_csv(sweep_.axes, outcomes_));
    write(folder / "sweep.json", json + "\n");
    return written_;
  }

  std::string scene_name() const { return fs::path(sweep_.options.scene).filename().string(); }

 private:
  void write(const fs::path& file, const std::string& text) {
    if (const auto written = write_text_file(file, text); !written) {
      report_.problem(written.error(), {});
      written_ = ExitCode::other;
      return;
    }
    report_.document()["files"].push_back(file.string());
    report_.line(file.string());
  }

  const Sweep& sweep_;
  SweepScenes& scenes_;
  Report& report_;
  SeriesSheet sheet_;
  v1::Scene reference_scene_;
  client::SweepComparison comparison_;
  std::vector<SweepOutcome> outcomes_;  ///< By row.
  ExitCode written_ = ExitCode::done;
};

boost::asio::awaitable<ExitCode> sweep_on(Session& session, Interrupts& interrupts,
                                          const Sweep& sweep, SweepScenes& scenes, Report& report) {
  Sweeping sweeping(sweep, scenes, report);
  SeriesPlan plan;
  plan.jobs = {client::series_id(), sweeping.scene_name() + ", sweep",
               static_cast<std::uint32_t>(sweep.rows.size()), sweep.pictures.parts()};
  plan.noun = "rows";
  plan.make = [&](std::uint32_t index) { return sweeping.make(index); };
  plan.label = [&](std::uint32_t index) { return sweep.rows[sweep.order[index]].label; };
  const TakePart take = [&](SeriesPart part, ProgressView& view) {
    sweeping.take(std::move(part), view);
  };
  const ExitCode ended = co_await follow_series(session, interrupts, plan, take, report);
  const ExitCode written = sweeping.report();
  co_return ended == ExitCode::done ? written : ended;
}

ExitCode run(const SweepOptions& options) {
  Report report(options.common.json);
  const auto sweep = understand(options, report);
  if (!sweep) return report.finish(ExitCode::bad_input);
  SweepScenes scenes(*sweep);
  if (!scenes.check(report)) return report.finish(ExitCode::bad_input);
  const InterruptibleWork work = [&](Session& session, Interrupts& interrupts) {
    return sweep_on(session, interrupts, *sweep, scenes, report);
  };
  return report.finish(with_any_server(options.common, report, work));
}

void declare(SweepOptions& values, Options& options) {
  declare_scene(values.scene, options);
  options.push_back({.names = "--vary",
                     .target = &values.vary,
                     .meaning =
                         "an option below and what it is in turn, such as method=exact,rgb or "
                         "spp=1,4,16 (or with ; where values have commas); several: all "
                         "combinations",
                     .type = "NAME=VALUE,…",
                     .required = true});
  options.push_back({.names = "--reference",
                     .target = &values.reference,
                     .meaning = "the row that the others are compared with: its number, or values "
                                "that no other has, such as method=exact",
                     .type = "ROW",
                     .shows_default = true});
  options.push_back({.names = "-o,--output",
                     .target = &values.folder,
                     .meaning = "the folder for sweep.csv and sweep.json"});
  options.push_back(
      {.names = "--pictures",
       .target = &values.pictures.files,
       .meaning = "a .png or .exr a row, with a place for its number: rows/%03d.exr"});
  options.push_back(
      {.names = "--sheet",
       .target = &values.sheet,
       .meaning = "a .png of the rows' pictures side by side; of more than 100 some"});
  declare_overrides(values.overrides, options);
  declare_common(values.common, options);
}

}  // namespace

Command commands::sweep() {
  return make_command<SweepOptions>(
      "sweep", "render a scene with all combinations of some options, and compare them", declare,
      run);
}

}  // namespace metamer::cli
