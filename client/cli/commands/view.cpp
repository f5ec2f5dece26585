#include "client/session/view.h"

#include <boost/asio/steady_timer.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <chrono>
#include <cmath>
#include <map>
#include <numbers>

#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/output/output.h"
#include "client/cli/scene_input.h"
#include "client/cli/shared_options.h"
#include "client/session/problems.h"
#include "client/tools/pictures/planned_developing.h"
#include "client/tools/scene/camera_motion.h"
#include "common/color/error_statistics.h"
#include "common/scene/methods.h"

namespace metamer::cli {
namespace {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;

struct ViewOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
  std::uint32_t frames = 60;
  double degrees = 10;                ///< That the camera swings to both sides of its place.
  std::optional<double> rate;         ///< Frames a second, at most.
  std::optional<std::string> output;  ///< A .png of the complete picture.
};

/// A frame as it came.
struct Recorded {
  v1::Frame frame;
  std::uint32_t width = 0, height = 0;
  double after = 0;  ///< Seconds since the one before.
};

std::string milliseconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%9.1f", 1000 * seconds);
  return text;
}

void report_row(const char* name, const std::vector<double>& seconds, Report& report) {
  const ErrorStatistics times = error_statistics(seconds);
  char padded[32];
  std::snprintf(padded, sizeof padded, "%-14s", name);
  report.line(padded + milliseconds(times.median) + milliseconds(times.percentile_95) +
              milliseconds(times.maximum));
  report.document()[name] = {
      {"median", times.median}, {"percentile_95", times.percentile_95}, {"longest", times.maximum}};
}

/// "9 of 160×120, 1 of 640×480"
std::string sizes_text(const std::vector<Recorded>& recorded) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> counts;
  for (const Recorded& one : recorded) ++counts[{one.width, one.height}];
  std::string text;
  for (const auto& [size, count] : counts)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " of " +
            std::to_string(size.first) + "×" + std::to_string(size.second);
  return text;
}

void report_frames(const std::vector<Recorded>& recorded, Report& report) {
  Json& frames = report.document()["frames"] = Json::array();
  std::vector<double> apart, rendered, developed;
  double whole = 0;
  for (const Recorded& one : recorded) {
    Json row = to_json(one.frame);
    row["width"] = one.width;
    row["height"] = one.height;
    row["after"] = one.after;
    frames.push_back(std::move(row));
    if (frames.size() > 1) apart.push_back(one.after);
    rendered.push_back(one.frame.render());
    developed.push_back(one.frame.develop());
    if (frames.size() > 1) whole += one.after;
  }
  if (recorded.empty()) return report.line("no frames");
  std::string text = std::to_string(recorded.size()) + " frames (" + sizes_text(recorded) + ")";
  if (!apart.empty()) {
    const double rate = static_cast<double>(apart.size()) / whole;
    char number[48];
    std::snprintf(number, sizeof number, ", %.1f a second", rate);
    text += number;
    report.document()["rate"] = rate;
  }
  report.line(text);
  report.line("milliseconds     median      95 %  longest");
  report_row("first", {recorded.front().after}, report);
  if (!apart.empty()) report_row("apart", apart, report);
  report_row("rendered", rendered, report);
  report_row("developed", developed, report);
}

/// Moves the camera with each frame, and asks for the next while this one is looked at; until all
/// are there, or `enough`.
asio::awaitable<Answer<std::vector<Recorded>>> record(View& view, const v1::Camera& camera,
                                                      const ViewOptions& options,
                                                      const bool& enough) {
  asio::steady_timer pace(co_await asio::this_coro::executor);
  std::vector<Recorded> recorded;
  co_await view.ask();
  co_await view.ask();
  auto last = Clock::now();
  for (std::uint32_t i = 1; i <= options.frames && !enough; ++i) {
    Answer<View::Picture> picture = co_await view.next();
    if (!picture) co_return tl::unexpected<SessionError>(std::move(picture.error()));
    const auto now = Clock::now();
    recorded.push_back({picture->frame, picture->width, picture->height,
                        std::chrono::duration<double>(now - last).count()});
    last = now;
    if (options.rate && i < options.frames) {
      pace.expires_at(now + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(1 / *options.rate)));
      co_await pace.async_wait(asio::use_awaitable);
    }
    // The last change brings the camera back.
    const double swing = std::sin(2 * std::numbers::pi * i / options.frames);
    v1::UpdateView change;
    change.set_revision(i);
    *change.mutable_camera() =
        i == options.frames ? camera : client::orbit(camera, options.degrees * swing);
    Answer<void> sent = co_await view.update(std::move(change));
    if (!sent) co_return tl::unexpected<SessionError>(std::move(sent.error()));
    co_await view.ask();
  }
  co_return recorded;
}

/// Lets the picture grow until it has all its samples.
asio::awaitable<Answer<View::Picture>> complete(View& view, std::uint64_t revision) {
  while (true) {
    Answer<View::Picture> picture = co_await view.next();
    if (!picture) co_return picture;
    if (picture->frame.revision() == revision && picture->frame.complete()) co_return picture;
    co_await view.ask();
  }
}

/// Writes a frame that has all its samples.
ExitCode write_picture(const View::Picture& picture, const v1::Plan& plan, const std::string& file,
                       Report& report) {
  const auto developing = planned_developing(plan);
  const Result<void> written =
      !developing ? Result<void>(tl::unexpected(developing.error()))
                  : write_rgb(static_cast<int>(picture.width), static_cast<int>(picture.height),
                              picture.rgb, file, developing->developing);
  if (!written) {
    report.problem(written.error(), {});
    return ExitCode::other;
  }
  if (picture.frame.out_of_gamut() > 0) {
    Problem note;
    note.message = std::to_string(picture.frame.out_of_gamut()) + " pixels are of colours that " +
                   developing->developing.space.name + " does not hold: clipped";
    report.note(note);
  }
  report.line(file + ", " + std::to_string(picture.frame.samples()) + " samples of each pixel");
  return ExitCode::done;
}

asio::awaitable<ExitCode> view_on(Session& session, Interrupts& interrupts,
                                  const ViewOptions& options, const CheckedScene& scene,
                                  Report& report) {
  const auto fail = [&](const SessionError& error) {
    report_problems(scene, from_wire(error.problems), report);
    return error.problems.empty() ? report.session_error(error) : ExitCode::bad_input;
  };
  const Submission submission = make_submission(scene.scene(), scene.assets(), scene.name(), false);
  Answer<std::unique_ptr<View>> opened = co_await View::open(session, submission);
  if (!opened) co_return fail(opened.error());
  View& view = **opened;
  const v1::Plan& plan = view.plan();
  for (const v1::Notice& notice : plan.notice()) report_notice(scene, notice, report);
  report.line(scene.name() + ", " + std::to_string(plan.width()) + "×" +
              std::to_string(plan.height()) + ", by " + method_text(plan.method()) + " on the " +
              plan.backend() + " backend");
  report.document()["plan"] = to_json(plan);

  bool enough = false;
  interrupts.on_first([&] { enough = true; });
  Answer<std::vector<Recorded>> recorded =
      co_await record(view, scene.scene().camera(), options, enough);
  interrupts.on_first({});
  if (!recorded) co_return fail(recorded.error());
  report_frames(*recorded, report);
  if (enough) co_return ExitCode::cancelled;
  if (!options.output) co_return ExitCode::done;

  const Answer<View::Picture> picture = co_await complete(view, options.frames);
  if (!picture) co_return fail(picture.error());
  co_return write_picture(*picture, view.plan(), *options.output, report);
}

/// What no parser of words finds.
ExitCode check(const ViewOptions& options, Report& report) {
  std::string wrong;
  if (options.rate && !(*options.rate >= 0.001 && *options.rate <= 1e6))
    wrong = "--rate: frames a second from 0.001 to 1000000";
  if (!(options.degrees >= 0 && options.degrees <= 180)) wrong = "--swing: degrees from 0 to 180";
  if (options.output && std::filesystem::path(*options.output).extension() != ".png")
    wrong = "--output: \"" + *options.output + "\" does not end in .png";
  if (!wrong.empty()) report.error(wrong);
  OutputOptions output;
  if (options.output) output.files = {*options.output};
  return wrong.empty() ? check_output(output, report) : ExitCode::bad_input;
}

ExitCode run(const ViewOptions& options) {
  Report report(options.common.json);
  const ExitCode checked = check(options, report);
  if (checked != ExitCode::done) return report.finish(checked);
  const auto scene = load_scene(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  return report.finish(
      with_any_server(options.common, report, [&](Session& session, Interrupts& interrupts) {
        return view_on(session, interrupts, options, *scene, report);
      }));
}

void declare(ViewOptions& values, Options& options) {
  declare_scene(values.scene, options);
  options.push_back({.names = "--record",
                     .target = &values.frames,
                     .meaning = "so many frames",
                     .shows_default = true,
                     .range = {{1, 1'000'000}}});
  options.push_back({.names = "--swing",
                     .target = &values.degrees,
                     .meaning = "of the camera around its target, to each side",
                     .type = "DEGREES",
                     .shows_default = true});
  options.push_back(
      {.names = "--rate", .target = &values.rate, .meaning = "frames a second, at most"});
  options.push_back({.names = "-o,--output",
                     .target = &values.output,
                     .meaning = "a .png of the last frame, once it has all its samples"});
  declare_overrides(values.overrides, options);
  declare_common(values.common, options);
}

}  // namespace

Command commands::view() {
  return make_command<ViewOptions>(
      "view", "look at a scene while the camera moves, and measure the frames", declare, run);
}

}  // namespace metamer::cli
