#include "server/worker/job.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "common/scene/settings.h"
#include "common/wire/frame.h"
#include "server/cpu/ticks.h"
#include "server/cpu/tracer.h"
#include "server/film/factor_sink.h"
#include "server/gl/context.h"
#include "server/render/choose.h"
#include "server/scene/camera_space.h"
#include "server/scene/compile.h"
#include "server/worker/assets.h"
#include "server/worker/gl_picture.h"
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
  scene.mutable_settings()->set_backend(options_.gl ? v1::GL : v1::CPU);
  ++work_;

  // Compile it: names, spectra and meshes become flat arrays.
  tl::expected<RenderScene, std::vector<Problem>> compiled;
  view_turns_.serve_while([&] {
    compiled = compile_scene(scene, stored_assets(message.asset(), options_.store), stopped_);
  });
  ++work_;
  if (stopped_) return send_stopped();
  if (!compiled) return send_problems(compiled.error());
  const CameraSpace space = CameraSpace::of(*compiled);
  geometry_key_ = geometry_key(objects_key(scene, *compiled, message.asset()), space);
  scene_ = std::make_unique<RenderScene>(std::move(*compiled));
  space.place(*scene_);

  keep_factors_ = message.keep_factors();
  if (keep_factors_ && options_.gl)
    return send_failure(v1::Failed::BAD_INPUT, "the gl backend keeps no factors for relighting");
  if (keep_factors_)
    keep_factors_ = send_factors(nullptr, scene_factors(*scene_).SerializeAsString());

  // Plan, and let the daemon decide.
  settings_ = scene.settings();
  if (!make_plan(message)) return send_stopped();
  timing_.set_compile(seconds_since(begun_) - timing_.pilot() -
                      (timing_.pilot() > 0 ? timing_.acceleration() : 0));
  v1::WorkerEnvelope planned = envelope();
  *planned.mutable_planned()->mutable_plan() = plan_;
  link_.send(planned);
}

/// Plans, after a look at pilot pixels where the method is to be chosen or explained. False when
/// stopped.
bool Job::make_plan(const v1::CompileJob& message) {
  const Capabilities capabilities{.threads = options_.threads};
  const bool is_auto = settings_.method().has_auto_();
  const v1::Auto goal = settings_.method().auto_();
  if (message.has_chosen()) *settings_.mutable_method() = message.chosen();

  std::vector<v1::Prediction> predictions;
  std::string objection;
  if (settings_.method().has_auto_() || message.explain()) {
    if (!build_geometry()) return false;
    const auto start = Clock::now();
    const PilotScene pilot{*scene_, *geometry_, settings_, capabilities, stopped_, work_};
    if (settings_.method().has_auto_()) {
      Choice choice = choose(pilot, goal, seconds_since(begun_));
      *settings_.mutable_method() = choice.method;
      method_ = std::move(choice.prepared);
      predictions = std::move(choice.predictions);
      objection = std::move(choice.objection);
    }
    if (message.explain()) predictions = predict_all(pilot, settings_.method());
    timing_.set_pilot(seconds_since(start));
    if (stopped_) return false;
  }

  plan_ = metamer::make_plan(*scene_, settings_, capabilities);
  plan_.set_scene_digest(message.scene_sha256());
  plan_.mutable_prediction()->Assign(predictions.begin(), predictions.end());
  if (is_auto) *plan_.mutable_auto_() = goal;
  const auto say = [&](const char* field, const std::string& message) {
    v1::Notice* notice = plan_.add_notice();
    notice->set_field(field);
    notice->set_message(message);
  };
  if (!objection.empty()) say("settings.method.auto", objection);
  if (options_.gl && !predictions.empty())
    say("settings.backend", "seconds are predicted for the cpu backend");
  if (message.keep_factors() && !keep_factors_)
    say("material", "the scene's spectra are too many to keep factors for");
  return true;
}

void Job::render(const v1::RenderTiles& message) {
  ended_ = false;
  for (const v1::TileRect& tile : message.tile())
    if (!is_sound(tile, plan_)) return send_failure(v1::Failed::SERVER, "a tile outside the plan");
  const MappedFilm film(options_.film_descriptor, plan_);
  if (!film) return send_failure(v1::Failed::SERVER, "no shared memory for the picture");

  const Film view{film.xyz(), plan_.width(), plan_.height()};
  if (options_.gl) {
    const auto done = render_by_gl(message, view);
    if (!done && !stopped_) {
      send_failure(v1::Failed::SERVER, done.error().message);
      // The next job gets a new worker, with a new context.
      if (!gl::check_context()) std::_Exit(1);
      return;
    }
  } else {
    tbb::task_arena arena(static_cast<int>(plan_.threads()));
    arena.execute(
        [&] { return prepare_method() && build_geometry() && render_tiles(message, view); });
    timing_.set_models(static_cast<double>(model_ticks_) /
                       static_cast<double>(std::max<std::uint64_t>(ticks_, 1)));
  }
  if (stopped_) return send_stopped();
  v1::WorkerEnvelope done = envelope();
  *done.mutable_done()->mutable_timing() = timing_;
  if (plan_.has_auto_() && message.last()) measure_promise(*done.mutable_done());
  send_last(done);
}

bool Job::build_geometry() {
  if (geometry_) return true;
  const auto start = Clock::now();
  view_turns_.serve_while([&] {
    tbb::task_arena arena(static_cast<int>(options_.threads));
    arena.execute([&] { geometry_ = cpu::EmbreeScene::build(*scene_, stopped_); });
  });
  timing_.set_acceleration(seconds_since(start));
  ++work_;
  return geometry_.has_value();
}

/// Makes the method's tables. Not stopped by anything.
bool Job::prepare_method() {
  if (!method_) {
    const auto start = Clock::now();
    method_ = make_method(plan_, *scene_);
    timing_.set_prepare(seconds_since(start));
    ++work_;
  }
  return true;
}

/// Holds the promise against pixels that had no part in the choice.
void Job::measure_promise(v1::JobDone& done) {
  const double elapsed = seconds_since(begun_);
  const Capabilities capabilities{.threads = options_.threads};
  if (!build_geometry()) return;  // stopped
  v1::Accuracy& accuracy = *done.mutable_accuracy();
  *accuracy.mutable_error() =
      measure({*scene_, *geometry_, settings_, capabilities, stopped_, work_}, *method_);
  if (plan_.auto_().has_deadline()) return accuracy.set_kept(elapsed <= plan_.auto_().deadline());
  accuracy.set_kept(accuracy.error().maximum() <= plan_.auto_().tolerance());
  if (!accuracy.kept() && !plan_.method().has_exact()) done.mutable_better()->mutable_exact();
}

/// False when stopped.
bool Job::render_tiles(const v1::RenderTiles& message, const Film& film) {
  const cpu::Tracer tracer(*scene_, *geometry_, plan_);
  std::atomic<int> next = 0;
  while (next < message.tile_size() && !stopped_) {
    render_some(tracer, message, film, next);
    if (!stopped_ && view_turns_.waiting()) view_turns_.serve();
  }
  return !stopped_;
}

/// Lets each thread take the next tile, so that they are begun in the daemon's order; until the
/// last one, or until others have waited for a turn's time.
void Job::render_some(const cpu::Tracer& tracer, const v1::RenderTiles& message, const Film& film,
                      std::atomic<int>& next) {
  const auto begun = Clock::now();
  const auto is_over = [&] { return view_turns_.waiting() && Clock::now() - begun > turn_time; };
  tbb::parallel_for(0u, plan_.threads(), [&](unsigned) {
    cpu::Tracer::Workspace workspace = tracer.make_workspace();
    FilmSink film_sink(*method_, film, plan_.spp());
    FactorSink factor_sink(film_sink, plan_.spp());
    PixelSink& sink = keep_factors_ ? static_cast<PixelSink&>(factor_sink) : film_sink;
    const std::uint64_t start = cpu::ticks();
    for (int i = next++; i < message.tile_size() && !stopped_; i = next++) {
      const v1::TileRect& tile = message.tile(i);
      const Rect rect{tile.x(), tile.y(), tile.width(), tile.height()};
      workspace.rays = 0;
      if (keep_factors_) factor_sink.begin(rect);
      tracer.render(rect, sink, workspace, stopped_, work_);
      if (stopped_) return;
      // A picture outlives its factors: a tile without any says so.
      if (keep_factors_ && !too_many_factors_)
        too_many_factors_ = !send_factors(&tile, factor_sink.finish().SerializeAsString());
      send_tile(tile, workspace.rays);
      if (is_over()) break;
    }
    ticks_ += cpu::ticks() - start;
    model_ticks_ += cpu::model_ticks(workspace);
  });
}

/// Renders region by region, each of them whole before its tiles are told.
Result<void> Job::render_by_gl(const v1::RenderTiles& message, const Film& film) {
  prepare_method();
  if (!gl_picture_) {
    auto made = GlPicture::make(*options_.gl, geometry_key_, *scene_, plan_, *method_, stopped_);
    if (!made) return tl::unexpected(made.error());
    gl_picture_ = std::make_unique<GlPicture>(std::move(*made));
    gl_picture_->add_preparation(timing_);
    ++work_;
  }
  const auto done = gl_picture_->render(
      message, film, stopped_, work_, view_turns_,
      [&](const v1::TileRect& tile, std::uint64_t rays) { send_tile(tile, rays); });
  gl_picture_->set_passes(timing_);
  return done;
}

void Job::send_tile(const v1::TileRect& tile, std::uint64_t rays) {
  v1::WorkerEnvelope tile_done = envelope();
  *tile_done.mutable_tile_done()->mutable_tile() = tile;
  tile_done.mutable_tile_done()->set_rays(rays);
  link_.send(tile_done);
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
