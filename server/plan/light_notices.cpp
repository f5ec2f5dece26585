#include "server/plan/light_notices.h"

#include <algorithm>

namespace metamer {
namespace {

void say(const std::string& field, const std::string& message, v1::Plan& plan) {
  v1::Notice& notice = *plan.add_notice();
  notice.set_field(field);
  notice.set_message(message);
}

}  // namespace

void notice_lights(const RenderScene& scene, const std::vector<Need>& needs, v1::Plan& plan) {
  if (plan.light_samples() == 0) return;
  const auto first = std::find_if(needs.begin(), needs.end(), [](const Need& need) {
    return need.feature == Feature::area_lights || need.feature == Feature::environment;
  });
  say(first->field,
      "a pixel looks at " + std::to_string(std::uint64_t{plan.spp()} * plan.light_samples()) +
          " points of it (spp " + std::to_string(plan.spp()) + " × light_samples " +
          std::to_string(plan.light_samples()) + "): noise beside the error of colour",
      plan);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const RenderObject& object = scene.objects[i];
    if (object.shape != RenderObject::Shape::mesh || object.shading == v1::PHONG) continue;
    say("object[" + std::to_string(i) + "]",
        "under lights with a surface and environments its model is evaluated at every sample, as "
        "by PHONG",
        plan);
    break;
  }
}

}  // namespace metamer
