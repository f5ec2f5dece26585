#include "server/worker/view.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <utility>

#include "common/scene/limits.h"
#include "common/scene/settings.h"
#include "common/scene/validate.h"
#include "server/gl/context.h"
#include "server/plan/plan.h"
#include "server/scene/compile.h"
#include "server/worker/guests.h"
#include "server/worker/problems.h"

namespace metamer {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A picture that takes longer for one sample of each pixel is first shown coarsely.
constexpr double coarse_above = 1.0 / 30;  // s
/// On a side of the coarse picture.
constexpr std::uint32_t coarse_pixels = 4;
/// Farther away than this, in sizes of the scene, f32 is no longer fine enough for it.
constexpr double far_away = 16;
/// A band with all around it is a frame of a worker's message.
constexpr std::size_t band_bytes = 240u << 10;
/// What compiles a view's scene is not cancelled.
const std::atomic<bool> never = false;

/// The settings of a view are those of a scene but for what makes no sense in one.
v1::Settings view_settings(const v1::Settings& from, bool gl) {
  v1::Settings settings = with_defaults(from);
  settings.set_backend(gl ? v1::GL : v1::CPU);
  if (settings.method().has_auto_()) settings.mutable_method()->mutable_exact();
  return settings;
}

Problem too_large() {
  return {.field = "settings.width",
          .file = {},
          .message = "a view has at most " + std::to_string(limits::max_view_pixels) + " pixels"};
}

bool fits(const v1::Settings& settings) {
  return std::uint64_t{settings.width()} * settings.height() <= limits::max_view_pixels;
}

/// Each change in the place of what has its name.
template <class Item>
void replace(const google::protobuf::RepeatedPtrField<Item>& changes, const std::string& field,
             google::protobuf::RepeatedPtrField<Item>& to, View::Problems& problems) {
  for (int i = 0; i < changes.size(); ++i) {
    const auto found = std::find_if(
        to.begin(), to.end(), [&](const Item& item) { return item.name() == changes[i].name(); });
    if (found != to.end())
      *found = changes[i];
    else
      problems.push_back(
          {.field = field + "[" + std::to_string(i) + "].name",
           .file = {},
           .message = "the scene has no " + field + " named " + quoted(changes[i].name())});
  }
}

/// Each in the place of what has its name, or behind the others.
void add_names(const AssetNames& more, AssetNames& to) {
  for (const v1::AssetName& asset : more) {
    const auto found = std::find_if(
        to.begin(), to.end(), [&](const v1::AssetName& one) { return one.name() == asset.name(); });
    (found != to.end() ? *found : *to.Add()) = asset;
  }
}

/// The pattern's samples so that each frame is about as well off as the next: the pattern's own
/// order goes from one side of the pixel to the other.
std::vector<SamplePoint> spread(const std::vector<SamplePoint>& pattern) {
  const std::size_t count = pattern.size();
  // A step near the golden section that meets every sample.
  auto step = static_cast<std::size_t>(0.618 * static_cast<double>(count)) + 1;
  while (std::gcd(step, count) != 1) ++step;
  std::vector<SamplePoint> result;
  for (std::size_t i = 0, at = count / 2; i < count; ++i, at = (at + step) % count)
    result.push_back(pattern[at]);
  return result;
}

}  // namespace

View::View(std::uint64_t id, const WorkerOptions& options, Link& link, Work& work)
    : id_(id), options_(options), link_(link), work_(work) {}

View::~View() = default;

bool View::open(const v1::OpenView& message) {
  const auto start = Clock::now();
  v1::Scene scene;
  const auto bytes = read_stored(options_.store, message.scene_sha256());
  if (!bytes || !scene.ParseFromString(*bytes)) {
    send_closed(v1::Failed::BAD_INPUT, "the scene's bytes are no scene");
    return false;
  }
  *scene.mutable_settings() = view_settings(scene.settings(), options_.gl);
  opened_with_ = message.asset_size();
  if (auto done = compile(scene, message.asset()); !done) {
    send_closed(v1::Failed::BAD_INPUT, "the scene has problems", done.error());
    return false;
  }
  return prepare(start);
}

/// Those that objects may be made of: what updates add is of spectra.
AssetNames View::opened(const AssetNames& names) const {
  return {names.begin(), names.begin() + opened_with_};
}

/// Imports and places everything.
tl::expected<void, View::Problems> View::compile(const v1::Scene& scene, const AssetNames& names) {
  if (!fits(scene.settings())) return tl::unexpected(Problems{too_large()});
  auto compiled = compile_scene(scene, stored_assets(names, options_.store), never);
  ++work_;
  if (!compiled) return tl::unexpected(std::move(compiled.error()));
  picture_.reset();  // before the scene that it refers to
  space_ = CameraSpace::of(*compiled);
  objects_key_ = objects_key(scene, *compiled, opened(names));
  scene_ = std::make_unique<RenderScene>(std::move(*compiled));
  space_.place(*scene_);
  message_ = scene;
  names_ = names;
  return {};
}

/// Lights, materials and camera anew, while the objects stay; all, where they do not.
tl::expected<void, View::Problems> View::recompile(const v1::Scene& scene,
                                                   const AssetNames& names) {
  if (!fits(scene.settings())) return tl::unexpected(Problems{too_large()});
  auto compiled = compile_appearance(scene, stored_assets(names, options_.store));
  ++work_;
  if (!compiled) return tl::unexpected(std::move(compiled.error()));
  if (objects_key(scene, *compiled, opened(names)) != objects_key_) return compile(scene, names);
  compiled->objects = std::move(scene_->objects);
  compiled->meshes = std::move(scene_->meshes);
  *scene_ = std::move(*compiled);
  for (RenderLight& light : scene_->lights) space_.place(light);
  space_.place(scene_->camera);
  message_ = scene;
  names_ = names;
  return {};
}

bool View::turn() {
  // The first frame of a revision is drawn to its end, or a stream of updates would show nothing.
  const bool first = next_part_ > 0 && drawn_ == 0;
  if (update_ && !first && !change(*std::exchange(update_, std::nullopt))) return false;
  return !has_frame() || draw();
}

bool View::change(const v1::UpdateView& message) {
  const auto start = Clock::now();
  Problems problems;
  v1::Scene scene = message_;
  if (message.has_camera()) *scene.mutable_camera() = message.camera();
  if (message.has_settings())
    *scene.mutable_settings() = view_settings(message.settings(), options_.gl);
  replace(message.light(), "light", *scene.mutable_light(), problems);
  replace(message.material(), "material", *scene.mutable_material(), problems);
  AssetNames names = names_;
  add_names(message.asset(), names);
  if (static_cast<std::size_t>(names.size()) > limits::max_assets)
    problems.push_back({.field = "asset", .file = {}, .message = "the view has too many files"});

  const bool camera_alone =
      !message.has_settings() && message.light_size() + message.material_size() == 0;
  if (problems.empty() && camera_alone) problems = validate_scene(scene);
  if (!problems.empty()) return refuse(message.revision(), problems);
  if (camera_alone) {
    RenderCamera camera = compile_camera(scene.camera());
    space_.place(camera);
    if (camera.eye.norm() <= far_away) {
      scene_->camera = camera;
      message_ = std::move(scene);
      begin_anew();
      revision_ = message.revision();
      send_updated(start, false);
      return true;
    }
  }
  const auto done = camera_alone ? compile(scene, names) : recompile(scene, names);
  if (!done) return refuse(message.revision(), done.error());
  revision_ = message.revision();
  return prepare(start);
}

/// Plans, makes the tables, and begins with the first frame.
bool View::prepare(Clock::time_point start) {
  plan_ = make_plan(*scene_, message_.settings(), {.threads = options_.threads});
  auto method = make_method(plan_, *scene_);
  Result<void> done;
  if (!picture_) {
    auto made = ViewPicture::make(*scene_, geometry_key(objects_key_, space_), options_);
    if (made)
      picture_ = std::move(*made);
    else
      done = tl::unexpected(made.error());
  }
  auto developer = Developer::make(plan_);
  if (!developer && done) done = tl::unexpected(developer.error());
  if (done) done = picture_->change(plan_, *method);
  if (!done) {
    send_closed(v1::Failed::SERVER, done.error().message);
    return false;
  }
  method_ = std::move(method);
  developer_ = *developer;
  pattern_ = spread(sample_pattern(plan_.spp()));
  begin_anew();
  ++work_;
  send_updated(start, true);
  return true;
}

void View::begin_anew() {
  drawn_ = 0;
  next_part_ = 0;
  frame_seconds_ = 0;
  coarse_ = sample_seconds_ > coarse_above;
}

/// The first sample goes right into the sum, any other is added to it.
bool View::draw() {
  const auto start = Clock::now();
  const std::uint32_t part = coarse_ ? coarse_pixels : 1;
  const std::uint32_t width = (plan_.width() + part - 1) / part;
  const std::uint32_t height = (plan_.height() + part - 1) / part;
  std::vector<float>& to = drawn_ == 0 ? sum_ : sample_;
  to.resize(std::size_t{width} * height * 3);
  const auto sample = std::span(pattern_).subspan(drawn_, 1);
  const auto whole =
      picture_->draw({to.data(), width, height}, sample, start + turn_time, next_part_, work_);
  ++work_;
  if (!whole) {
    send_closed(v1::Failed::SERVER, whole.error().message);
    // The next one gets a new worker, with a new context.
    if (options_.gl && !gl::check_context()) std::_Exit(1);
    return false;
  }
  frame_seconds_ += seconds_since(start);
  if (!*whole) return true;

  if (drawn_ > 0)
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += sample_[i];
  if (!coarse_ && ++drawn_ == 1) sample_seconds_ = frame_seconds_;
  coarse_ = false;
  --credits_;
  send_frame(width, height);
  next_part_ = 0;
  frame_seconds_ = 0;
  return true;
}

/// In bands of whole rows, which the daemon hands on as they are.
void View::send_frame(std::uint32_t width, std::uint32_t height) {
  const auto start = Clock::now();
  v1::Frame frame;
  frame.set_render(frame_seconds_);
  const auto samples = static_cast<std::uint32_t>(std::max<std::size_t>(1, drawn_));
  rgb_.resize(std::size_t{width} * height * 3);
  frame.set_out_of_gamut(developer_->develop(sum_, 1 / static_cast<float>(samples), rgb_));
  frame.set_develop(seconds_since(start));
  frame.set_revision(revision_);
  frame.set_samples(samples);
  frame.set_complete(drawn_ == pattern_.size());

  const std::size_t row = std::size_t{width} * 3;
  const auto rows = static_cast<std::uint32_t>(std::max<std::size_t>(1, band_bytes / row));
  for (std::uint32_t y = 0; y < height; y += rows) {
    const std::uint32_t count = std::min(rows, height - y);
    v1::WorkerEnvelope message = event();
    v1::FrameBand& band = *message.mutable_view_event()->mutable_band();
    band.set_width(width);
    band.set_height(height);
    band.set_first_row(y);
    band.set_rgb(rgb_.data() + y * row, count * row);
    if (y + count == height) *band.mutable_frame() = frame;
    link_.send(message);
  }
}

void View::send_updated(Clock::time_point start, bool planned) {
  v1::WorkerEnvelope message = event();
  v1::ViewUpdated& updated = *message.mutable_view_event()->mutable_updated();
  updated.set_revision(revision_);
  if (planned) *updated.mutable_plan() = plan_;
  updated.set_seconds(seconds_since(start));
  link_.send(message);
}

bool View::refuse(std::uint64_t revision, const Problems& problems) {
  v1::WorkerEnvelope message = event();
  v1::ViewRefused& refused = *message.mutable_view_event()->mutable_refused();
  refused.set_revision(revision);
  add_problems(problems, *refused.mutable_problem());
  link_.send(message);
  return true;
}

void View::send_closed(v1::Failed::Kind kind, const std::string& reason, const Problems& problems) {
  v1::WorkerEnvelope message = event();
  v1::Failed& failed = *message.mutable_view_event()->mutable_closed()->mutable_reason();
  failed.set_kind(kind);
  failed.set_reason(reason);
  add_problems(problems, *failed.mutable_problem());
  link_.send(message);
}

v1::WorkerEnvelope View::event() const {
  v1::WorkerEnvelope message;
  message.mutable_view_event()->set_view_id(id_);
  return message;
}

}  // namespace metamer
