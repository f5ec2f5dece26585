#include "server/film/develop.h"

namespace metamer {

Result<Developer> Developer::make(const v1::Plan& plan) {
  const auto planned = planned_development(plan);
  if (!planned) return tl::unexpected(planned.error());
  return Developer(*planned, plan.development().linear());
}

Developer::Developer(const PlannedDevelopment& planned, bool linear)
    : matrix_(multiply(planned.space.from_xyz, planned.adaptation)),
      codes_(linear ? Transfer{} : planned.space.transfer) {}

std::uint64_t Developer::develop(std::span<const float> xyz, float scale,
                                 std::span<std::uint8_t> rgb) const {
  std::uint64_t outside = 0;
  for (std::size_t i = 0; i + 3 <= xyz.size(); i += 3) {
    const Vector3 color = {double{scale * xyz[i]}, double{scale * xyz[i + 1]},
                           double{scale * xyz[i + 2]}};
    bool clipped = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3& row = matrix_[c];
      const auto linear =
          static_cast<float>(row[0] * color[0] + row[1] * color[1] + row[2] * color[2]);
      clipped |= codes_.is_below(linear) || codes_.is_above(linear);
      rgb[i + c] = codes_(linear);
    }
    outside += clipped;
  }
  return outside;
}

}  // namespace metamer
