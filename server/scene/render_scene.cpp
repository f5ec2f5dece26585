#include "server/scene/render_scene.h"

namespace metamer {

std::set<std::uint32_t> seen_materials(const RenderScene& scene) {
  std::set<std::uint32_t> seen;
  for (const RenderObject& object : scene.objects) {
    if (!seen.insert(object.material).second) continue;
    if (const auto texture = scene.materials[object.material].texture) {
      const auto& inks = scene.textures[*texture].materials;
      seen.insert(inks.begin(), inks.end());
    }
  }
  return seen;
}

}  // namespace metamer
