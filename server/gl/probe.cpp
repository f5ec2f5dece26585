#include "server/gl/probe.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace metamer::gl {
namespace {

/// A picture that takes so long says what the next one will: what is the same for each, as drawing
/// the scene's triangles, is a small part of it.
constexpr double long_enough = 0.004;  // s
/// No larger than a region of a picture.
constexpr std::uint32_t first_side = 64, last_side = 256;

/// The whole of a plan's picture, as one region of fewer pixels.
class SmallPicture {
 public:
  SmallPicture(const v1::Plan& plan, std::uint32_t side) {
    const std::uint32_t longer = std::max(plan.width(), plan.height());
    const auto fewer = [&](std::uint32_t pixels) {
      return side >= longer ? pixels : std::max(1u, pixels * side / longer);
    };
    width_ = fewer(plan.width());
    height_ = fewer(plan.height());
    xyz_.resize(std::size_t{width_} * height_ * 3);
  }

  double pixels() const { return static_cast<double>(width_) * height_; }

  /// Seconds for so many samples of each pixel; infinite where it can't be drawn.
  double draw(Renderer& renderer, unsigned samples, const std::atomic<bool>& stopped,
              std::atomic<std::uint64_t>& work) {
    const auto start = std::chrono::steady_clock::now();
    renderer.begin({.film = {xyz_.data(), width_, height_},
                    .samples = sample_pattern(samples),
                    .tiles = {{0, 0, width_, height_}},
                    .tile_done = {},
                    .keep_factors = false});
    const auto whole = renderer.draw({stopped, [] { return false; }, work});
    if (!whole || !*whole) return std::numeric_limits<double>::infinity();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

 private:
  std::uint32_t width_, height_;
  std::vector<float> xyz_;
};

}  // namespace

double DrawingProbe::picture_seconds(const v1::Plan& plan, const Method& method, double,
                                     const std::atomic<bool>& stopped,
                                     std::atomic<std::uint64_t>& work) {
  if (!renderer_.change(plan, method, stopped)) return std::numeric_limits<double>::infinity();
  // The first drawing is slower: drivers finish their compiling there.
  if (side_ == 0) {
    side_ = first_side;
    SmallPicture(plan, side_).draw(renderer_, 1, stopped, work);
    while (side_ < last_side &&
           SmallPicture(plan, side_).draw(renderer_, 1, stopped, work) < long_enough)
      side_ *= 2;
  }
  SmallPicture picture(plan, side_);
  picture.draw(renderer_, 1, stopped, work);
  const double one = picture.draw(renderer_, 1, stopped, work);
  const double sample = std::max(0.0, picture.draw(renderer_, 2, stopped, work) - one);
  const double rest = std::max(0.0, one - sample);
  return (rest + sample * plan.spp()) * plan.width() * plan.height() / picture.pixels();
}

}  // namespace metamer::gl
