#include "server/worker/view.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <numeric>
#include <utility>

#include "server/plan/color_notices.h"
#include "server/plan/plan.h"
#include "server/worker/problems.h"
#include "server/worker/view_turns.h"

namespace metamer::worker {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// A picture that takes longer for one sample of each pixel is first shown coarsely.
constexpr double coarse_above = 1.0 / 30;  // s
/// On a side of the coarse picture.
constexpr std::uint32_t coarse_pixels = 4;
/// A band with all around it is a frame of a worker's message.
constexpr std::size_t band_bytes = 240u << 10;
/// A turn ends by its time, and by nothing else.
const std::atomic<bool> no_end = false;

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

View::View(std::uint64_t id, const WorkerOptions& options, Link& link, Work& work,
           std::function<void()> wake)
    : id_(id), options_(options), link_(link), work_(work), scene_(options, std::move(wake)) {}

View::~View() = default;

bool View::open(const v1::OpenView& message) {
  begun_ = Clock::now();
  auto scene = options_.scene(message.scene_sha256());
  const Problems problems =
      scene ? scene_.open(*std::move(scene), message.asset()) : Problems{std::move(scene.error())};
  if (!problems.empty()) send_closed(failed_for(problems));
  return problems.empty();
}

bool View::turn() {
  if (scene_.is_importing()) return adopt();
  if (update_ && !is_first_under_way() && !change(*std::exchange(update_, std::nullopt)))
    return false;
  if (scene_.is_importing()) return true;
  // While the first frame is drawn there is no newest one to speak of.
  if (!is_first_under_way()) answer_probes();
  return !has_frame() || draw();
}

bool View::adopt() {
  auto imported = scene_.end_import();
  ++work_;
  if (!imported && method_) return refuse(asked_revision_, imported.error());
  if (!imported) {
    send_closed(failed_for(imported.error()));
    return false;
  }
  timing_ = imported->timing;
  view_probe_.forget_scene();
  scene_.adopt(std::move(*imported));
  revision_ = asked_revision_;
  return prepare();
}

bool View::change(const v1::UpdateView& message) {
  begun_ = Clock::now();
  asked_revision_ = message.revision();
  const auto changed = scene_.change(message);
  timing_.Clear();
  timing_.set_compile(seconds_since(begun_));
  ++work_;
  if (!changed) return refuse(asked_revision_, changed.error());
  if (*changed == ViewScene::Change::objects) return true;
  revision_ = asked_revision_;
  if (*changed == ViewScene::Change::appearance) return prepare();
  begin_anew();
  send_updated(false);
  return true;
}

/// Plans, makes the tables, and begins with the first frame.
bool View::prepare() {
  const Problems refused =
      refusals(scene_.scene(), scene_.settings(), options_.plan_capabilities(), false);
  if (!refused.empty()) {
    v1::Failed failed = failed_for(refused);
    failed.set_reason(refused.front().message);
    send_closed(failed);
    return false;
  }
  const auto start = Clock::now();
  plan_ = make_plan(scene_.scene(), scene_.settings(), options_.plan_capabilities());
  auto method = make_method(plan_, scene_.scene());
  notice_colors(scene_.scene(), *method, plan_);
  notice_ends_of_data(scene_.scene(), plan_);
  auto developer = Developer::make(plan_);
  timing_.set_prepare(seconds_since(start));
  const Result<void> done = developer ? scene_.renderer().change(plan_, *method, no_end)
                                      : tl::unexpected(developer.error());
  if (!done) {
    send_closed(failed_for(v1::Failed::SERVER, done.error().message));
    return false;
  }
  scene_.renderer().report(timing_);
  method_ = std::move(method);
  developer_ = *developer;
  view_probe_.forget_appearance();
  pattern_ = spread(sample_pattern(plan_.spp()));
  begin_anew();
  ++work_;
  send_updated(true);
  return true;
}

void View::begin_anew() {
  drawn_ = 0;
  is_shown_ = xyz_sent_ = false;
  under_way_ = false;
  frame_seconds_ = 0;
  coarse_ = sample_seconds_ > coarse_above;
}

/// The first sample goes right into the sum, any other is added to it.
bool View::draw() {
  if (drawn_ == pattern_.size()) return send_frame(plan_.width(), plan_.height()), true;
  const auto start = Clock::now();
  const std::uint32_t part = coarse_ ? coarse_pixels : 1;
  const std::uint32_t width = (plan_.width() + part - 1) / part;
  const std::uint32_t height = (plan_.height() + part - 1) / part;
  if (!std::exchange(under_way_, true)) {
    std::vector<float>& to = drawn_ == 0 ? sum_ : sample_;
    to.resize(std::size_t{width} * height * 3);
    scene_.renderer().begin({.film = {to.data(), width, height},
                             .samples = {pattern_[drawn_]},
                             .tiles = {},
                             .tile_done = {},
                             .keep_factors = false});
  }
  const auto is_over = [&] { return Clock::now() >= start + turn_time; };
  const auto whole = scene_.renderer().draw({no_end, is_over, work_});
  ++work_;
  if (!whole) {
    send_closed(failed_for(v1::Failed::SERVER, whole.error().message));
    // The next one gets a new worker, with a new device.
    if (!options_.backend->is_sound()) std::_Exit(1);
    return false;
  }
  frame_seconds_ += seconds_since(start);
  if (!*whole) return true;

  if (drawn_ > 0)
    for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += sample_[i];
  if (!coarse_ && ++drawn_ == 1) sample_seconds_ = frame_seconds_;
  coarse_ = false;
  send_frame(width, height);
  is_shown_ = true;
  shown_part_ = part;
  under_way_ = false;
  frame_seconds_ = 0;
  return true;
}

/// Of the newest frame, which `sum_` holds.
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

  const bool xyz = credits_.front() && frame.complete();
  credits_.pop_front();
  xyz_sent_ |= xyz;
  if (xyz) {
    // What was developed: sums by the same factor.
    xyz_.resize(sum_.size());
    const float scale = 1 / static_cast<float>(samples);
    std::transform(sum_.begin(), sum_.end(), xyz_.begin(), [&](float v) { return scale * v; });
  }
  send_bands(width, height, frame, xyz);
}

void View::answer_probes() {
  for (const v1::Probe& probe : std::exchange(probes_, {})) {
    v1::WorkerEnvelope message = event();
    v1::Probed& probed = *message.mutable_view_event()->mutable_probed();
    probed = view_probe_.look(scene_, plan_, probe);
    probed.set_number(probe.number());
    probed.set_revision(revision_);
    if (is_shown_ && probe.x() < plan_.width() && probe.y() < plan_.height()) {
      const auto across = [&](std::uint32_t size) { return (size - 1) / shown_part_ + 1; };
      const float scale = 1 / static_cast<float>(std::max<std::size_t>(1, drawn_));
      const Xyz mean =
          mean_of({across(plan_.width()), across(plan_.height()), shown_part_, sum_, scale}, probe);
      probed.mutable_xyz()->Add(mean.begin(), mean.end());
    }
    link_.send(message);
    ++work_;
  }
}

/// In bands of whole rows, which the daemon hands on as they are.
void View::send_bands(std::uint32_t width, std::uint32_t height, const v1::Frame& frame, bool xyz) {
  static_assert(std::endian::native == std::endian::little, "X Y Z are little-endian");
  const std::size_t row = std::size_t{width} * 3;
  const std::size_t row_bytes = row * (xyz ? 1 + sizeof(float) : 1);
  const auto rows = static_cast<std::uint32_t>(std::max<std::size_t>(1, band_bytes / row_bytes));
  for (std::uint32_t y = 0; y < height; y += rows) {
    const std::uint32_t count = std::min(rows, height - y);
    v1::WorkerEnvelope message = event();
    v1::FrameBand& band = *message.mutable_view_event()->mutable_band();
    band.set_width(width);
    band.set_height(height);
    band.set_first_row(y);
    band.set_rgb(rgb_.data() + y * row, count * row);
    if (xyz) band.set_xyz(xyz_.data() + y * row, count * row * sizeof(float));
    if (y + count == height) *band.mutable_frame() = frame;
    link_.send(message);
  }
}

void View::send_updated(bool planned) {
  v1::WorkerEnvelope message = event();
  v1::ViewUpdated& updated = *message.mutable_view_event()->mutable_updated();
  updated.set_revision(revision_);
  if (planned) *updated.mutable_plan() = plan_;
  updated.set_seconds(seconds_since(begun_));
  v1::Timing& timing = *updated.mutable_timing();
  timing.set_compile(timing_.compile());
  timing.set_acceleration(timing_.acceleration());
  timing.set_prepare(timing_.prepare());
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

void View::send_closed(const v1::Failed& reason) {
  v1::WorkerEnvelope message = event();
  *message.mutable_view_event()->mutable_closed()->mutable_reason() = reason;
  link_.send(message);
}

v1::WorkerEnvelope View::event() const {
  v1::WorkerEnvelope message;
  message.mutable_view_event()->set_view_id(id_);
  return message;
}

}  // namespace metamer::worker
