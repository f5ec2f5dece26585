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

}  // namespace metamer::client
