#include "client/tools/pictures/planned_developing.h"

#include <utility>

#include "common/scene/development.h"

namespace metamer::client {

Result<PlannedDeveloping> planned_developing(const v1::Plan& plan) {
  auto planned = planned_development(plan);
  if (!planned) return tl::unexpected(std::move(planned.error()));
  return PlannedDeveloping{.developing = {.space = std::move(planned->space),
                                          .adaptation = planned->adaptation,
                                          .linear = plan.development().linear()},
                           .unadapted = std::move(planned->unadapted),
                           .shown_white = std::move(planned->shown_white)};
}

Image adapted(Image picture, const Developing& developing) {
  for (std::size_t i = 0; i < picture.pixels.size(); i += 3) {
    const Xyz shown = multiply(developing.adaptation, Xyz{picture.pixels[i], picture.pixels[i + 1],
                                                          picture.pixels[i + 2]});
    for (std::size_t c = 0; c < 3; ++c) picture.pixels[i + c] = static_cast<float>(shown[c]);
  }
  return picture;
}

}  // namespace metamer::client
