#include "tests/server/worker/fake_backend.h"

namespace metamer::worker {
namespace {

class FakeProbe : public Probe {
 public:
  explicit FakeProbe(const FakeBackend& backend) : backend_(backend) {}
  bool prepare(const std::atomic<bool>& cancelled) override { return !cancelled; }
  TracedPixels trace(const v1::Plan&, PixelRun, const std::atomic<bool>&,
                     std::atomic<std::uint64_t>&) const override {
    return {backend_.traced_, 1};
  }
  /// The first object, at the right half of the picture.
  std::optional<SeenPoint> look(const v1::Plan& plan, std::uint32_t x,
                                std::uint32_t) const override {
    if (x < plan.width() / 2) return std::nullopt;
    return SeenPoint{.object = 0, .place = {}, .normal = {0, 0, 1}, .eye = Gather(1), .light = {1}};
  }
  double picture_seconds(const v1::Plan&, const Method&, double, const std::atomic<bool>&,
                         std::atomic<std::uint64_t>&) override {
    return 1;
  }

 private:
  const FakeBackend& backend_;
};

class FakeRenderer : public Renderer {
 public:
  explicit FakeRenderer(const FakeBackend& backend) : backend_(backend) {}

  bool prepare(const std::atomic<bool>& cancelled) override {
    ++backend_.seen.prepared;
    return !cancelled;
  }

  Result<void> change(const v1::Plan&, const Method&, const std::atomic<bool>&) override {
    ++backend_.seen.changes;
    if (!backend_.change_problem.empty()) return problem(backend_.change_problem);
    return {};
  }

  void begin(Picture picture) override {
    ++backend_.seen.pictures;
    backend_.seen.samples = picture.samples;
    picture_ = std::move(picture);
    is_told_ = !picture_.tiles.empty();
    if (!is_told_)
      for (std::uint32_t y = 0; y < picture_.film.height; ++y)
        picture_.tiles.push_back({0, y, picture_.film.width, 1});
    next_ = 0;
  }

  Result<bool> draw(const Control& control) override {
    ++backend_.seen.draws;
    if (!backend_.draw_problem.empty()) return problem(backend_.draw_problem);
    while (next_ < picture_.tiles.size()) {
      backend_.before_tile();
      if (control.cancelled) return false;
      const Rect& tile = picture_.tiles[next_++];
      for (std::uint32_t y = tile.y; y < tile.y + tile.height; ++y)
        for (std::uint32_t x = tile.x; x < tile.x + tile.width; ++x)
          picture_.film.set(x, y,
                            {static_cast<float>(x), static_cast<float>(y),
                             static_cast<float>(picture_.samples.size())});
      ++control.work;
      const v1::TileFactors factors = kept(tile);
      if (is_told_) picture_.tile_done({tile, 7, picture_.keep_factors ? &factors : nullptr});
      if (control.is_over()) break;
    }
    return next_ == picture_.tiles.size();
  }

  void report(v1::Timing& timing) override { timing.set_models(0.25); }
  std::unique_ptr<Probe> make_probe() override { return std::make_unique<FakeProbe>(backend_); }

 private:
  static v1::TileFactors kept(const Rect& tile) {
    v1::TileFactors factors;
    for (std::uint32_t i = 0; i < tile.width * tile.height; ++i) factors.add_count(0);
    return factors;
  }

  const FakeBackend& backend_;
  Picture picture_{};
  bool is_told_ = false;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<Renderer> FakeBackend::make_renderer(const RenderScene&,
                                                     const std::string& key) const {
  ++seen.renderers;
  seen.key = key;
  return std::make_unique<FakeRenderer>(*this);
}

}  // namespace metamer::worker
