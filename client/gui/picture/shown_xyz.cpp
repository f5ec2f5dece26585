#include "client/gui/picture/shown_xyz.h"

#include "client/tools/pictures/planned_developing.h"

namespace metamer::gui {

Developing developing_of(const v1::Plan* plan) {
  if (plan == nullptr) return {};
  auto planned = client::planned_developing(*plan);
  return planned ? std::move(planned->developing) : Developing{};
}

ShownXyz shown_xyz(const Picture& picture) {
  return {.xyz = picture.xyz, .developing = developing_of(picture.plan.get())};
}

}  // namespace metamer::gui
