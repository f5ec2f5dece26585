#include "server/worker/job.h"

#include <sys/mman.h>
#include <sys/stat.h>

#include "common/scene/settings.h"
#include "common/wire/frame.h"
#include "server/film/factor_sink.h"
#include "server/plan/color_notices.h"
#include "server/render/choose.h"
#include "server/render/verify.h"
#include "server/scene/camera_space.h"
#include "server/scene/compile.h"
#include "server/worker/assets.h"
#include "server/worker/problems.h"

namespace metamer::worker {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The film's memory, mapped for as long as this lives.
class MappedFilm {
 public:
  MappedFilm(int descriptor, const v1::Plan& plan)
      : size_(std::size_t{plan.width()} * plan.height() * 3 * sizeof(float)) {
    struct stat status;
    if (fstat(descriptor, &status) != 0 || static_cast<std::size_t>(status.st_size) < size_) return;
    memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  }
  ~MappedFilm() {
    if (*this) munmap(memory_, size_);
  }
  MappedFilm(const MappedFilm&) = delete;
  MappedFilm& operator=(const MappedFilm&) = delete;
  explicit operator bool() const { return memory_ != MAP_FAILED; }
  float* xyz() const { return static_cast<float*>(memory_); }

 private:
  std::size_t size_;
  void* memory_ = MAP_FAILED;
};

/// A tile as the tracer wants it: inside the picture, its corner on multiples of 8.
bool is_sound(const v1::TileRect& tile, const v1::Plan& plan) {
  return tile.x() % 8 == 0 && tile.y() % 8 == 0 && tile.width() > 0 && tile.height() > 0 &&
         tile.x() < plan.width() && tile.width() <= plan.width() - tile.x() &&
         tile.y() < plan.height() && tile.height() <= plan.height() - tile.y();
}

}  // namespace

Job::Job(std::uint64_t id, const WorkerOptions& options, Link& link, Work& work,
         ViewTurns& view_turns)
    : id_(id), options_(options), link_(link), work_(work), view_turns_(view_turns) {}

Job::~Job() = default;

void Job::compile(const v1::CompileJob& message) {
  begun_ = Clock::now();

  // Parse the scene, with the defaults of its settings filled in.
  auto bytes = read_stored(options_.store, message.scene_sha256());
  v1::Scene scene;
  if (!bytes || !scene.ParseFromString(*bytes))
    return send_failure(v1::Failed::BAD_INPUT, "the scene's bytes are no scene");
  *scene.mutable_settings() = with_defaults(scene.settings());
  scene.mutable_settings()->set_backend(options_.backend->id());
  ++work_;

  // Compile it: names, spectra and meshes become flat arrays.
  tl::expected<RenderScene, std::vector<Problem>> compiled;
  view_turns_.serve_while([&] {
    compiled = compile_scene(scene, stored_assets(message.asset(), options_.store),
                             options_.meshes(message.asset(), stopped_), stopped_);
  });
  ++work_;
  if (stopped_) return send_stopped();
  if (!compiled) return send_problems(compiled.error());
  const CameraSpace space = CameraSpace::of(*compiled);
  const std::string key = geometry_key(objects_key(scene, *compiled, message.asset()), space);
  scene_ = std::make_unique<RenderScene>(std::move(*compiled));
  space.place(*scene_);
  renderer_ = options_.backend->make_renderer(*scene_, key);
  probe_ = renderer_->make_probe();

  settings_ = scene.settings();
  const auto refused =
      refusals(*scene_, settings_, options_.plan_capabilities(), message.keep_factors());
  if (!refused.empty()) return send_failure(v1::Failed::BAD_INPUT, refused.front().message);
  keep_factors_ = message.keep_factors();
  if (keep_factors_)
    keep_factors_ = send_factors(nullptr, scene_factors(*scene_).SerializeAsString());

  // Plan, and let the daemon decide.
  if (!make_plan(message)) return send_stopped();
  timing_.set_compile(seconds_since(begun_) - timing_.pilot() - timing_.prepare() -
                      timing_.acceleration());
  planned_setup_ = timing_.acceleration() + timing_.prepare();
  v1::WorkerEnvelope planned = envelope();
  *planned.mutable_planned()->mutable_plan() = plan_;
  link_.send(planned);
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
  if (is_open || message.explain()) {
    if (!build([&] { return probe_->prepare(stopped_); })) return false;
    const auto start = Clock::now();
    const PilotScene pilot{*scene_, *probe_, settings_, capabilities, stopped_, work_};
    if (is_open) {
      Choice choice = choose(pilot, goal, seconds_since(begun_));
      *settings_.mutable_method() = choice.method;
      method_ = std::move(choice.prepared);
      predictions = std::move(choice.predictions);
      objection = std::move(choice.objection);
    }
    if (message.explain()) predictions = predict_all(pilot, settings_.method());
    timing_.set_pilot(seconds_since(start));
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
  return true;
}

/// Says what the check of every pixel will cost. False when stopped.
bool Job::plan_verification() {
  if (!build([&] { return probe_->prepare(stopped_); })) return false;
  const auto start = Clock::now();
  const Capabilities capabilities = options_.plan_capabilities();
  plan_.set_verify_cost(metamer::verify_cost(
      {*scene_, *probe_, settings_, capabilities, stopped_, work_}, plan_, *method_));
  char text[96];
  std::snprintf(text, sizeof text,
                "a check of every pixel against the reference: about %.2g times the picture's work",
                plan_.verify_cost());
  plan_.add_need(text);
  timing_.set_pilot(timing_.pilot() + seconds_since(start));
  return !stopped_;
}

void Job::render(const v1::RenderTiles& message) {
  ended_ = false;
  for (const v1::TileRect& tile : message.tile())
    if (!is_sound(tile, plan_)) return send_failure(v1::Failed::SERVER, "a tile outside the plan");
  const MappedFilm film(options_.film_descriptor, plan_);
  if (!film) return send_failure(v1::Failed::SERVER, "no shared memory for the picture");

  const Film picture{film.xyz(), plan_.width(), plan_.height()};
  auto drawn = draw(message, picture);
  v1::WorkerEnvelope done = envelope();
  if (drawn && message.last() && !stopped_) drawn = conclude(picture, *done.mutable_done());
  if (stopped_) return send_stopped();
  if (!drawn) {
    send_failure(v1::Failed::SERVER, drawn.error().message);
    // The next job gets a new worker, with a new device.
    if (!options_.backend->is_sound()) std::_Exit(1);
    return;
  }
  *done.mutable_done()->mutable_timing() = timing_;
  done.mutable_done()->set_setup(timing_.acceleration() + timing_.prepare() - planned_setup_);
  send_last(done);
}

/// The picture is whole: what it is worth, beside what was promised.
Result<void> Job::conclude(const Film& film, v1::JobDone& done) {
  const double elapsed = seconds_since(begun_);
  if (settings_.verify()) {
    if (auto verified = verify(film, done); !verified || stopped_) return verified;
  } else if (plan_.has_auto_()) {
    measure_promise(done);
  }
  if (stopped_ || !plan_.has_auto_()) return {};
  v1::Accuracy& accuracy = *done.mutable_accuracy();
  const bool timed = plan_.auto_().has_deadline();
  accuracy.set_kept(timed ? elapsed <= plan_.auto_().deadline()
                          : accuracy.error().maximum() <= plan_.auto_().tolerance());
  if (!timed && !accuracy.kept() && !plan_.method().has_exact())
    done.mutable_better()->mutable_exact();
  return {};
}

/// Builds a hierarchy while the views have their turns. False when stopped.
bool Job::build(const std::function<bool()>& prepare) {
  const auto start = Clock::now();
  bool built = false;
  view_turns_.serve_while([&] { built = prepare(); });
  timing_.set_acceleration(timing_.acceleration() + seconds_since(start));
  ++work_;
  return built;
}

/// Makes the method's tables, where the choice of the method did not.
void Job::prepare_method() {
  if (method_) return;
  const auto start = Clock::now();
  method_ = make_method(plan_, *scene_);
  timing_.set_prepare(seconds_since(start));
  ++work_;
}

/// Makes what the renderer draws by, the first time.
Result<void> Job::prepare() {
  if (prepared_) return {};
  if (!build([&] { return renderer_->prepare(stopped_); })) return {};  // stopped
  const auto changed = renderer_->change(plan_, *method_, stopped_);
  prepared_ = changed.has_value();
  ++work_;
  return changed;
}

/// By pixels that had no part in the choice.
void Job::measure_promise(v1::JobDone& done) {
  const Capabilities capabilities = options_.plan_capabilities();
  if (!build([&] { return probe_->prepare(stopped_); })) return;  // stopped
  *done.mutable_accuracy() =
      measure({*scene_, *probe_, settings_, capabilities, stopped_, work_}, *method_);
}

/// By all pixels: the renderer draws the picture once more, by the reference.
Result<void> Job::verify(const Film& film, v1::JobDone& done) {
  const auto start = Clock::now();
  Verification check(*scene_, plan_, film);
  prepared_ = false;  // it will know another method
  const auto changed = renderer_->change(check.plan(), check.method(), stopped_);
  ++work_;
  if (!changed || stopped_) return changed;
  renderer_->begin(check.picture([&](std::uint32_t tiles) {
    constexpr std::uint64_t steps = 50;  // that are told of
    if (tiles * steps / check.tiles() == (tiles - 1) * steps / check.tiles()) return;
    v1::WorkerEnvelope message = envelope();
    message.mutable_tiles_verified()->set_tiles(tiles);
    link_.send(message);
  }));
  if (auto drawn = draw_on(); !drawn || stopped_) return drawn;
  *done.mutable_accuracy() = check.accuracy();
  timing_.set_verify(seconds_since(start));
  return {};
}

/// Draws the tiles.
Result<void> Job::draw(const v1::RenderTiles& message, const Film& film) {
  if (auto ready = prepare(); !ready || stopped_ || message.tile().empty()) return ready;
  Picture picture{.film = film,
                  .samples = sample_pattern(plan_.spp()),
                  .tiles = {},
                  .tile_done = [this](const DrawnTile& drawn) { take(drawn); },
                  .keep_factors = keep_factors_};
  for (const v1::TileRect& tile : message.tile())
    picture.tiles.push_back({tile.x(), tile.y(), tile.width(), tile.height()});
  renderer_->begin(std::move(picture));
  auto drawn = draw_on();
  renderer_->report(timing_);
  return drawn;
}

/// Draws on what the renderer has begun, until others have waited for a turn's time, and so on.
Result<void> Job::draw_on() {
  for (;;) {
    const auto begun = Clock::now();
    const auto is_over = [&] { return view_turns_.waiting() && Clock::now() - begun > turn_time; };
    const auto whole = renderer_->draw({stopped_, is_over, work_});
    if (!whole) return tl::unexpected(whole.error());
    if (*whole || stopped_) break;
    view_turns_.serve();
  }
  return {};
}

/// From any thread. A picture outlives its factors: a tile without any says so.
void Job::take(const DrawnTile& drawn) {
  v1::TileRect tile;
  tile.set_x(drawn.rect.x);
  tile.set_y(drawn.rect.y);
  tile.set_width(drawn.rect.width);
  tile.set_height(drawn.rect.height);
  if (drawn.factors && !too_many_factors_)
    too_many_factors_ = !send_factors(&tile, drawn.factors->SerializeAsString());
  send_tile(tile, drawn.rays);
}

void Job::send_tile(const v1::TileRect& tile, std::uint64_t rays) {
  v1::WorkerEnvelope tile_done = envelope();
  *tile_done.mutable_tile_done()->mutable_tile() = tile;
  tile_done.mutable_tile_done()->set_rays(rays);
  link_.send_with_others(tile_done);
}

/// In pieces that a worker's frame holds. False for more than is kept, or for none at all.
bool Job::send_factors(const v1::TileRect* tile, const std::string& bytes) {
  constexpr std::size_t piece_size = 128u << 10;
  if (bytes.empty() || bytes.size() > wire::max_factors) return false;
  for (std::size_t at = 0; at < bytes.size(); at += piece_size) {
    v1::WorkerEnvelope message = envelope();
    v1::FactorsPiece& piece = *message.mutable_factors_piece();
    if (tile) *piece.mutable_tile() = *tile;
    piece.set_data(bytes.substr(at, piece_size));
    link_.send(message);
  }
  return true;
}

v1::WorkerEnvelope Job::envelope() const {
  v1::WorkerEnvelope message;
  message.set_job_id(id_);
  return message;
}

void Job::send_problems(const std::vector<Problem>& problems) {
  v1::WorkerEnvelope message = envelope();
  v1::Failed* failed = message.mutable_failed();
  failed->set_kind(v1::Failed::BAD_INPUT);
  failed->set_reason("the scene has " + std::to_string(problems.size()) +
                     (problems.size() == 1 ? " problem" : " problems"));
  add_problems(problems, *failed->mutable_problem());
  send_last(message);
}

void Job::send_failure(v1::Failed::Kind kind, const std::string& reason) {
  v1::WorkerEnvelope message = envelope();
  message.mutable_failed()->set_kind(kind);
  message.mutable_failed()->set_reason(reason);
  send_last(message);
}

void Job::send_stopped() {
  v1::WorkerEnvelope message = envelope();
  message.mutable_stopped();
  send_last(message);
}

void Job::send_last(const v1::WorkerEnvelope& message) {
  ended_ = true;
  link_.send(message);
}

}  // namespace metamer::worker
