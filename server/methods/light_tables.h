#pragma once

#include <functional>

#include "server/methods/band_table.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// A scene's lights in bands, and what its fluorescences make of them.
struct LightTables {
  /// `power`: a spectrum in `bands` bands, of this luminance.
  LightTables(const RenderScene& scene, std::size_t bands,
              const std::function<std::vector<double>(const Spectrum&, double luminance)>& power);

  BandTable lights;  ///< A row a light of the scene.

  /// What a fluorescence makes of a light of luminance 1, and that of a light.
  const float* reradiated(std::size_t light, std::uint32_t fluorescence) const {
    return emitted.row(from[light].emission * fluorescences + fluorescence);
  }
  float luminance(std::size_t light) const { return from[light].luminance; }

  struct From {
    std::uint32_t emission;
    float luminance;
  };
  std::vector<From> from;     ///< By light.
  std::size_t fluorescences;  ///< Of the scene.
  BandTable emitted;          ///< A row for each of RenderScene::reradiated.
};

}  // namespace metamer
