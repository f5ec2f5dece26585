#include "server/worker/job.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "common/scene/settings.h"
#include "common/wire/frame.h"
#include "common/wire/picture_factors.h"
#include "server/film/factor_sink.h"
#include "server/plan/color_notices.h"
#include "server/render/choose.h"
#include "server/render/factor_size.h"
#include "server/render/verify.h"
#include "server/scene/camera_space.h"
#include "server/scene/compile.h"

namespace metamer::worker {

Result<v1::Scene> WorkerOptions::scene(const std::string& digest) const {
  const auto bytes = read_stored(store, digest);
  if (!bytes) {
    if (is_damage(bytes.error())) tell_damage(digest);
    return tl::unexpected(bytes.error());
  }
  v1::Scene scene;
  if (!scene.ParseFromString(*bytes)) return problem("the scene's bytes are no scene");
  return scene;
}

Job::Job(std::uint64_t id, const WorkerOptions& options, Link& link, Work& work,
         ViewTurns& view_turns)
    : messages_(id, link), options_(options), work_(work), view_turns_(view_turns) {}

Job::~Job() = default;

double Job::since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void Job::compile(const v1::CompileJob& message) {
  const RunClock::Span span(run_clock_, Phase::compile);
  begun_ = Clock::now();
  messages_.preparing(v1::Preparing::READING);

  // Parse the scene, with the defaults of its settings filled in.
  auto read = options_.scene(message.scene_sha256());
  if (!read) return messages_.failed({std::move(read.error())});
  v1::Scene scene = *std::move(read);
  *scene.mutable_settings() = with_defaults(scene.settings());
  scene.mutable_settings()->set_backend(options_.backend->id());
  ++work_;

  // Compile it: names, spectra and meshes become flat arrays.
  tl::expected<RenderScene, std::vector<Problem>> compiled;
  view_turns_.serve_while([&] {
    compiled = compile_scene(scene, options_.assets(message.asset()),
                             options_.meshes(message.asset(), stopped_),
                             options_.textures(message.asset()), stopped_);
  });
  ++work_;
  if (stopped_) return messages_.stopped(record());
  if (!compiled) return messages_.failed(compiled.error());
  const CameraSpace space = CameraSpace::of(*compiled);
  const std::string key = geometry_key(objects_key(scene, *compiled, message.asset()), space);
  scene_ = std::make_unique<RenderScene>(std::move(*compiled));
  space.place(*scene_);
  renderer_ = options_.backend->make_renderer(*scene_, key);
  probe_ = renderer_->make_probe();

  settings_ = scene.settings();
  const auto refused =
      refusals(*scene_, settings_, options_.plan_capabilities(), message.keep_factors());
  if (!refused.empty()) return messages_.failed(refused);
  keep_factors_ = message.keep_factors();
  if (keep_factors_)
    keep_factors_ = messages_.factors(nullptr, scene_factors(*scene_).SerializeAsString());

  // Plan, and let the daemon decide.
  if (!make_plan(message)) return messages_.stopped(record());
  timing_.set_compile(since(begun_) - timing_.pilot() - timing_.prepare() - timing_.acceleration());
  planned_setup_ = timing_.acceleration() + timing_.prepare();
  messages_.planned(plan_);
  if (message.prepare()) succeeds(prepare());
}

/// False for a step that ends early: it has said why.
bool Job::succeeds(const Result<void>& result) {
  if (stopped_) {
    messages_.stopped(record());
    return false;
  }
  if (!result) {
    messages_.failed(v1::Failed::SERVER, result.error().message);
    // The next job gets a new worker, with a new device.
    if (!options_.backend->is_sound()) std::_Exit(1);
  }
  return result.has_value();
}

/// Plans, after a look at pilot pixels where the method is to be chosen or explained. False when
/// stopped.
bool Job::make_plan(const v1::CompileJob& message) {
  const Capabilities capabilities = options_.plan_capabilities();
  const bool has_goal = settings_.has_goal();
  const v1::Goal goal = settings_.goal();
  settings_.clear_goal();
  const bool is_open = has_goal && !message.has_chosen();
  if (message.has_chosen()) *settings_.mutable_method() = message.chosen();

  std::vector<v1::Prediction> predictions;
  std::string objection;
  const bool looks = is_open || message.explain();
  if (looks && !build([&] { return probe_->prepare(stopped_); })) return false;
  messages_.preparing(v1::Preparing::PLANNING);
  if (looks) {
    const RunClock::Span span(run_clock_, Phase::pilot);
    const auto start = Clock::now();
    const PilotScene pilot{*scene_, *probe_, settings_, capabilities, stopped_, work_};
    if (is_open) {
      Choice choice = choose(pilot, goal, since(begun_));
      *settings_.mutable_method() = choice.method;
      method_ = std::move(choice.prepared);
      predictions = std::move(choice.predictions);
      objection = std::move(choice.objection);
    }
    if (message.explain()) predictions = predict_all(pilot, settings_.method());
    timing_.set_pilot(since(start));
    v1::Timing within_pilot;
    renderer_->report(within_pilot);
    if (stopped_) return false;
  }

  plan_ = metamer::make_plan(*scene_, settings_, capabilities);
  plan_.set_scene_digest(message.scene_sha256());
  prepare_method();
  notice_colors(*scene_, *method_, plan_);
  notice_ends_of_data(*scene_, plan_);
  plan_.mutable_prediction()->Assign(predictions.begin(), predictions.end());
  if (has_goal) *plan_.mutable_auto_() = goal;
  if (settings_.verify() && !plan_verification()) return false;
  const auto say = [&](const char* field, const std::string& message) {
    v1::Notice* notice = plan_.add_notice();
    notice->set_field(field);
    notice->set_message(message);
  };
  if (!objection.empty()) say("settings.goal", objection);
  if (message.keep_factors() && !keep_factors_)
    say("material", "the scene's spectra are too many to keep factors for");
  return plan_factors();
}

/// Says before it is drawn that a picture has too many factors, or takes smaller tiles. False when
/// stopped.
bool Job::plan_factors() {
  // Without mirrors and refractions a pixel has a few.
  if (!keep_factors_ || plan_.depth() == 0) return true;
  if (!build([&] { return probe_->prepare(stopped_); })) return false;
  messages_.preparing(v1::Preparing::PLANNING);
  const RunClock::Span span(run_clock_, Phase::pilot);
  const auto start = Clock::now();
  const FactorSize size = factor_size(*probe_, plan_, stopped_, work_);
  timing_.set_pilot(timing_.pilot() + since(start));
  const std::uint32_t side = size.tile_size(plan_, wire::max_factors);
  keep_factors_ = side > 0 && size.mean * plan_.width() * plan_.height() <=
                                  static_cast<double>(wire::max_picture_factors);
  if (keep_factors_ && side == plan_.tile_size()) return !stopped_;
  v1::Notice* notice = plan_.add_notice();
  notice->set_field(keep_factors_ ? "settings.tile_size" : "settings.depth");
  notice->set_message(
      keep_factors_ ? "tiles of 8 pixels, so that the factors of each are no more than can be kept"
                    : "no factors are kept: of a tile of 8 pixels they would be more than 3 MiB, "
                      "or of all the "
                      "picture more than 4 GiB; a lower depth has fewer");
  if (keep_factors_) plan_.set_tile_size(side);
  return !stopped_;
}

/// Says what the check of every pixel will cost. False when stopped.
bool Job::plan_verification() {
  if (!build([&] { return probe_->prepare(stopped_); })) return false;
  messages_.preparing(v1::Preparing::PLANNING);
  const RunClock::Span span(run_clock_, Phase::pilot);
  const auto start = Clock::now();
  const Capabilities capabilities = options_.plan_capabilities();
  plan_.set_verify_cost(metamer::verify_cost(
      {*scene_, *probe_, settings_, capabilities, stopped_, work_}, plan_, *method_));
  char text[96];
  std::snprintf(text, sizeof text,
                "a check of every pixel against the reference: about %.2g times the picture's work",
                plan_.verify_cost());
  plan_.add_need(text);
  timing_.set_pilot(timing_.pilot() + since(start));
  return !stopped_;
}

/// Builds a hierarchy while the views have their turns. False when stopped.
bool Job::build(const std::function<bool()>& prepare) {
  if (!std::exchange(built_, true)) messages_.preparing(v1::Preparing::HIERARCHY);
  const RunClock::Span span(run_clock_, Phase::acceleration);
  const auto start = Clock::now();
  bool built = false;
  view_turns_.serve_while([&] { built = prepare(); });
  timing_.set_acceleration(timing_.acceleration() + since(start));
  ++work_;
  return built;
}

/// Makes the method's tables, where the choice of the method did not.
void Job::prepare_method() {
  if (method_) return;
  messages_.preparing(v1::Preparing::TABLES);
  const RunClock::Span span(run_clock_, Phase::prepare);
  const auto start = Clock::now();
  method_ = make_method(plan_, *scene_);
  timing_.set_prepare(since(start));
  ++work_;
}

/// Makes what the renderer draws by, the first time.
Result<void> Job::prepare() {
  if (prepared_) return {};
  if (!build([&] { return renderer_->prepare(stopped_); })) return {};  // stopped
  const RunClock::Span span(run_clock_, Phase::prepare);
  const auto changed = renderer_->change(plan_, *method_, stopped_);
  prepared_ = changed.has_value();
  ++work_;
  if (!changed || stopped_ || std::exchange(told_prepared_, true)) return changed;
  renderer_->report(timing_);
  v1::Timing setup;
  setup.set_compile(timing_.compile());
  setup.set_acceleration(timing_.acceleration());
  setup.set_pilot(timing_.pilot());
  setup.set_prepare(timing_.prepare());
  messages_.prepared(setup);
  return changed;
}

}  // namespace metamer::worker
