// A camera that goes around a scene: a picture a frame.
#include <algorithm>

#include "client/cli/commands.h"
#include "client/cli/commands/series/follow_series.h"
#include "client/cli/commands/series/series_output.h"
#include "client/cli/commands/series/series_sheet.h"
#include "client/cli/scene_input.h"
#include "client/cli/send_scene.h"
#include "client/cli/shared_options.h"
#include "client/tools/pictures/save_pictures.h"
#include "client/tools/scene/camera_motion.h"
#include "client/tools/series/movie_command.h"
#include "client/tools/text/formatted.h"
#include "common/scene/settings.h"

namespace metamer::cli {
namespace {

using client::formatted;

struct TurntableOptions {
  CommonOptions common;
  std::string scene;
  std::string frames;
  std::uint32_t per_turn = 360;
  std::string sheet;
  Overrides overrides;
  OutputOptions output;
};

/// The options, understood.
struct Turntable {
  const TurntableOptions& options;
  std::vector<std::uint32_t> frames;
  SeriesOutput output;

  /// Turned by whole turns it is where it was.
  v1::Scene scene_of(std::uint32_t frame, const v1::Scene& scene) const {
    v1::Scene turned = scene;
    const double degrees = 360.0 * (frame % options.per_turn) / options.per_turn;
    if (degrees != 0) *turned.mutable_camera() = client::orbit(scene.camera(), degrees);
    return turned;
  }
};

/// Nothing: the options make no sense, which is said.
std::optional<Turntable> understand(const TurntableOptions& options, Report& report) {
  auto frames = client::parse_frames(options.frames);
  if (!frames) {
    report.error("--frames: " + frames.error().message);
    return std::nullopt;
  }
  auto output = SeriesOutput::read(options.output, "--output", options.sheet, *frames, report);
  if (!output) return std::nullopt;
  return Turntable{options, *std::move(frames), *std::move(output)};
}

/// How to make a movie of the frames, once all are there; empty: there is none to make.
std::string movie_hint(const Turntable& turntable, const v1::Settings& settings) {
  const auto& names = turntable.output.names();
  const auto png = std::find_if(names.begin(), names.end(), [](const client::FrameName& name) {
    return !client::is_exr(name.pattern());
  });
  if (turntable.frames.size() < 2 || png == names.end()) return {};
  const bool even = settings.width() % 2 == 0 && settings.height() % 2 == 0;
  return client::movie_command(*png, turntable.frames, even);
}

/// What became of one frame, for --json.
Json frame_json(const Turntable& turntable, const SeriesPart& part) {
  Json json = {{"frame", turntable.frames[part.index]}};
  if (!part.failure.empty()) json["failure"] = part.failure;
  if (!part.record) return json;
  json["handle"] = to_text(part.record->job);
  if (part.record->last.has_finished()) {
    json["timing"] = to_json(part.record->last.finished().timing());
    json["record"] = to_json(part.record->last.finished().record());
    if (part.record->last.finished().has_accuracy())
      json["accuracy"] = to_json(part.record->last.finished().accuracy());
    json["files"] = turntable.output.files(turntable.frames[part.index]);
  }
  return json;
}

boost::asio::awaitable<ExitCode> turn_on(Session& session, Interrupts& interrupts,
                                         const Turntable& turntable, const CheckedScene& scene,
                                         Report& report) {
  const JobParts parts = turntable.output.parts();
  if (!check_factors(session, scene, parts == JobParts::picture_and_factors, report))
    co_return ExitCode::bad_input;
  const auto count = static_cast<std::uint32_t>(turntable.frames.size());
  SeriesPlan plan{
      .jobs = {client::series_id(), scene.name() + ", turntable", count, parts},
      .noun = "frames",
      .make = [&](std::uint32_t index) -> Result<Submission> {
        return client::make_submission(turntable.scene_of(turntable.frames[index], scene.scene()),
                                       scene.assets(), scene.name(), false);
      },
      .label = [&](std::uint32_t index) { return formatted("frame %u", turntable.frames[index]); }};
  SeriesSheet sheet(turntable.options.sheet, count);
  ExitCode written = ExitCode::done;
  bool noted = false;
  report.document()["frames"] = Json::array();
  const TakePart take = [&](SeriesPart part, ProgressView& view) {
    report.document()["frames"].push_back(frame_json(turntable, part));
    const bool done = part.failure.empty();
    sheet.add(part.index, part.label, done ? &*part.record : nullptr);
    if (!done) return sheet.note(part.index, "failed");
    view.clear();
    // What is to be said of the scene is the same of each of its frames.
    if (!std::exchange(noted, true))
      for (const v1::Notice& notice : part.record->plan->notice())
        report_notice(scene, notice, report);
    const ExitCode code =
        turntable.output.write(turntable.frames[part.index], *part.record, scene.name(), report);
    if (code != ExitCode::done) written = code;
  };
  const ExitCode ended = co_await follow_series(session, interrupts, plan, take, report);
  if (ended == ExitCode::no_server || ended == ExitCode::cancelled) co_return ended;
  if (const ExitCode code = sheet.write(report); code != ExitCode::done) written = code;
  const bool all_there = ended != ExitCode::job_failed && written == ExitCode::done;
  const std::string hint =
      all_there ? movie_hint(turntable, with_defaults(scene.scene().settings())) : std::string();
  if (!hint.empty()) {
    report.document()["movie"] = hint;
    report.line("a movie: " + hint);
  }
  co_return ended == ExitCode::done ? written : ended;
}

ExitCode run(const TurntableOptions& options) {
  Report report(options.common.json);
  const auto turntable = understand(options, report);
  if (!turntable) return report.finish(ExitCode::bad_input);
  const auto scene = load_scene(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  const InterruptibleWork work = [&](Session& session, Interrupts& interrupts) {
    return turn_on(session, interrupts, *turntable, *scene, report);
  };
  return report.finish(with_any_server(options.common, report, work));
}

void declare(TurntableOptions& values, Options& options) {
  declare_scene(values.scene, options);
  options.push_back({.names = "--frames",
                     .target = &values.frames,
                     .meaning = "which frames, such as 0:359 or, by a step, 0:350:10",
                     .type = "FIRST:LAST[:STEP]",
                     .required = true});
  options.push_back(
      {.names = "--count",
       .target = &values.per_turn,
       .meaning =
           "frames of a whole turn about the camera's up, through its target; counter-clockwise "
           "as seen from above",
       .shows_default = true,
       .range = {{1, 1'000'000}}});
  declare_picture_files(values.output, options);
  for (Option& option : options)
    if (option.names == "-o,--output")
      option.meaning =
          "a .png or .exr a frame, with a place for its number: frames/booth-%04d.png; may be "
          "given "
          "several times";
  options.push_back({.names = "--sheet",
                     .target = &values.sheet,
                     .meaning = "a .png of the frames side by side; of more than 100 some"});
  declare_overrides(values.overrides, options);
  declare_common(values.common, options);
}

}  // namespace

Command commands::turntable() {
  return make_command<TurntableOptions>(
      "turntable", "render a scene from all around, a picture a frame", declare, run);
}

}  // namespace metamer::cli
