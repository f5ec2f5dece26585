#include "server/render/verify.h"

#include <algorithm>

#include "common/scene/settings.h"

namespace metamer {

namespace {

v1::Plan reference_plan(v1::Plan plan) {
  plan.mutable_method()->mutable_exact();
  return plan;
}

std::vector<Rect> plan_tiles(const v1::Plan& plan) {
  std::vector<Rect> tiles;
  const std::uint32_t side = plan.tile_size();
  for (std::uint32_t y = 0; y < plan.height(); y += side)
    for (std::uint32_t x = 0; x < plan.width(); x += side)
      tiles.push_back({x, y, std::min(side, plan.width() - x), std::min(side, plan.height() - y)});
  return tiles;
}

}  // namespace

Verification::Verification(const RenderScene& scene, const v1::Plan& plan, const Film& film)
    : plan_(reference_plan(plan)),
      method_(scene, scene.observer),
      white_(Reference(scene, scene.observer).white()),
      film_(film),
      tiles_(plan_tiles(plan)),
      reference_(std::size_t{film.width} * film.height * 3),
      errors_(std::size_t{film.width} * film.height) {}

Picture Verification::picture(std::function<void(std::uint32_t tiles)> compared) {
  return {.film = {reference_.data(), film_.width, film_.height},
          .samples = sample_pattern(plan_.spp()),
          .tiles = tiles_,
          .tile_done =
              [this, compared = std::move(compared)](const DrawnTile& tile) {
                compare(tile.rect);
                compared(++compared_);
              },
          .keep_factors = false};
}

void Verification::compare(const Rect& tile) {
  const auto lab = [&](const float* xyz) { return to_lab({xyz[0], xyz[1], xyz[2]}, white_); };
  for (std::uint32_t y = tile.y; y < tile.y + tile.height; ++y)
    for (std::uint32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const std::size_t at = std::size_t{y} * film_.width + x;
      errors_[at] = delta_e_00(lab(film_.xyz + 3 * at), lab(reference_.data() + 3 * at));
    }
}

v1::Accuracy Verification::accuracy() const {
  v1::Accuracy accuracy = accuracy_of(summarize(errors_), plan_, white_);
  accuracy.mutable_error()->set_share(1);
  return accuracy;
}

double verify_cost(const PilotScene& pilot, const v1::Plan& plan, const Method& method) {
  const TracedPixels pixels =
      pilot.probe.trace(plan, {0, pilot_count(plan)}, pilot.stopped, pilot.work);
  const ReferenceMethod reference(pilot.scene, pilot.scene.observer);
  constexpr double difference = 700;  // ns: two colours to Lab, and ΔE00
  return (counted_pixel_cost(reference, pixels) + difference) / counted_pixel_cost(method, pixels);
}

}  // namespace metamer
