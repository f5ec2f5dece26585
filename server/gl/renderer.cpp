#include "server/gl/renderer.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <optional>

#include "server/gl/passes.h"
#include "server/gl/probe.h"
#include "server/gl/regions.h"

namespace metamer::gl {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A hook for tests: after so many samples of regions (METAMER_TEST_LOSE_CONTEXT) the context is
/// gone, as a GPU that is reset takes it.
void lose_context_for_tests(const Context& context) {
  static const char* text = std::getenv("METAMER_TEST_LOSE_CONTEXT");
  static const long loss = text ? std::strtol(text, nullptr, 10) : 0;
  static long samples = 0;
  if (loss > 0 && ++samples == loss) context.release();
}

class Rasteriser : public Renderer {
 public:
  Rasteriser(const RenderScene& scene, std::string key, Device& device, unsigned threads)
      : scene_(scene), key_(std::move(key)), device_(device), threads_(threads) {}

  bool prepare(const std::atomic<bool>&) override { return true; }

  Result<void> change(const v1::Plan& plan, const Method& method,
                      const std::atomic<bool>& cancelled) override {
    end();
    const auto start = Clock::now();
    const std::size_t uploads = device_.uploads(), compiled = device_.programs().compiled();
    if (!geometry_) {
      auto geometry = device_.geometry(key_, scene_, cancelled);
      if (!geometry) return tl::unexpected(geometry.error());
      geometry_ = std::move(*geometry);
      upload_seconds_ += seconds_since(start);
    }
    const auto uploaded = Clock::now();
    auto passes = Passes::create(scene_, *geometry_, plan, method, device_.programs(),
                                 device_.capabilities().timers());
    if (!passes) return tl::unexpected(passes.error());
    passes_.emplace(std::move(*passes));
    program_seconds_ += seconds_since(uploaded);
    uploaded_ = uploaded_ || device_.uploads() != uploads;
    compiled_ = compiled_ || device_.programs().compiled() != compiled;
    return {};
  }

  void begin(Picture picture) override {
    end();
    picture_ = std::move(picture);
    regions_ = regions_of(picture_.tiles, Passes::max_side);
    next_region_ = next_row_ = 0;
  }

  /// Region by region, each of them whole before its tiles are told; is told to stop between their
  /// samples.
  Result<bool> draw(const Control& control) override {
    if (region_) passes_->bind();
    while (region_ || has_region()) {
      if (!region_)
        if (auto begun = begin_region(); !begun) return tl::unexpected(begun.error());
      const auto start = Clock::now();
      const auto whole = draw_region(control);
      region_seconds_ += seconds_since(start);
      if (!whole) end();
      if (!whole || !*whole) return whole;
      end_region();
      if (control.is_over()) break;
    }
    return !region_ && !has_region();
  }

  void report(v1::Timing& timing) override {
    timing.set_acceleration(timing.acceleration() + std::exchange(upload_seconds_, 0));
    timing.set_prepare(timing.prepare() + std::exchange(program_seconds_, 0));
    timing.clear_pass();
    for (const Pass pass : all_passes) {
      v1::PassTime& time = *timing.add_pass();
      time.set_name(name_of(pass));
      time.set_seconds(passes_ ? passes_->clock().seconds(pass) : 0);
      time.set_gpu(device_.capabilities().timers());
    }
  }

  std::vector<std::string> warm() const override {
    std::vector<std::string> found;
    if (passes_ && !compiled_) found.push_back("programs");
    if (geometry_ && !uploaded_) found.push_back("geometry");
    return found;
  }

  std::unique_ptr<Probe> make_probe() override {
    return std::make_unique<DrawingProbe>(*this, scene_, threads_);
  }

 private:
  void end() { region_.reset(); }

  bool has_region() const {
    return picture_.tiles.empty() ? next_row_ < picture_.film.height
                                  : next_region_ < regions_.size();
  }

  Result<void> begin_region() {
    const Film& film = picture_.film;
    const std::uint32_t rows = std::min(rows_at_once(film.width), film.height - next_row_);
    const Rect region =
        picture_.tiles.empty() ? Rect{0, next_row_, film.width, rows} : regions_[next_region_].rect;
    const auto start = Clock::now();
    if (auto begun = passes_->begin(region, film); !begun) return begun;
    region_ = region;
    next_sample_ = 0;
    region_seconds_ = seconds_since(start);
    return {};
  }

  /// Goes on with the region under way. True: it is in the film.
  Result<bool> draw_region(const Control& control) {
    const std::vector<SamplePoint>& samples = picture_.samples;
    while (next_sample_ < samples.size()) {
      if (control.cancelled) return false;
      if (auto done = passes_->add(samples[next_sample_], control); !done)
        return tl::unexpected(done.error());
      ++next_sample_;
      control.work += std::uint64_t{region_->width} * region_->height;
      lose_context_for_tests(device_.context());
      if (next_sample_ < samples.size() && control.is_over()) return false;
    }
    if (auto done = passes_->finish(picture_.film, samples.size(), control); !done)
      return tl::unexpected(done.error());
    return !control.cancelled;
  }

  void end_region() {
    pixel_seconds_ = region_seconds_ /
                     static_cast<double>(std::uint64_t{region_->width} * region_->height) /
                     static_cast<double>(picture_.samples.size());
    if (picture_.tiles.empty()) {
      next_row_ += region_->height;
    } else {
      // Camera rays alone: the GPU does not count those of shadows.
      for (const Rect& tile : regions_[next_region_].tiles)
        if (picture_.tile_done)
          picture_.tile_done(
              {tile, std::uint64_t{tile.width} * tile.height * picture_.samples.size(), nullptr});
      ++next_region_;
    }
    end();
  }

  /// As many as take about a frame's time and fit into memory with what their pixels gather of each
  /// light. A GPU draws all at once.
  std::uint32_t rows_at_once(std::uint32_t width) const {
    constexpr std::uint64_t bytes = 64u << 20;
    constexpr double frame = 0.02;  // s
    const double fit =
        static_cast<double>(bytes / (std::uint64_t{width} * (scene_.lights.size() + 1) * 16));
    const double in_time =
        frame / (pixel_seconds_ * width * static_cast<double>(picture_.samples.size()));
    return static_cast<std::uint32_t>(std::clamp(std::min(fit, in_time), 8.0, 16384.0));
  }

  const RenderScene& scene_;
  std::string key_;
  Device& device_;
  unsigned threads_;
  std::shared_ptr<const Geometry> geometry_;
  std::optional<Passes> passes_;
  Picture picture_{};
  std::vector<Region> regions_;  ///< Of the tiles; without tiles regions are rows.
  std::size_t next_region_ = 0, next_sample_ = 0;
  std::uint32_t next_row_ = 0;
  std::optional<Rect> region_;   ///< Under way.
  double region_seconds_ = 0;    ///< That went into it.
  double pixel_seconds_ = 1e-6;  ///< Of a sample, in the last region; first of a slow device.
  double upload_seconds_ = 0, program_seconds_ = 0;
  bool uploaded_ = false, compiled_ = false;  ///< For this scene, not for an earlier one.
};

class Rasterising : public Backend {
 public:
  Rasterising(Device& device, unsigned threads) : device_(device), threads_(threads) {}

  v1::Backend id() const override { return v1::GL; }
  std::string name() const override { return "gl"; }
  Features features() const override { return gl::features; }
  void describe(v1::Capabilities& to) const override { *to.mutable_gl() = device_.capabilities(); }
  Result<void> enter() override { return device_.context().make_current(); }
  bool is_sound() const override { return check_context().has_value(); }
  std::unique_ptr<Renderer> make_renderer(const RenderScene& scene,
                                          const std::string& key) const override {
    return std::make_unique<Rasteriser>(scene, key, device_, threads_);
  }

 private:
  Device& device_;
  unsigned threads_;
};

}  // namespace

std::unique_ptr<Backend> make_backend(Device& device, unsigned threads) {
  return std::make_unique<Rasterising>(device, threads);
}

}  // namespace metamer::gl
