#pragma once

#include <string>
#include <vector>

#include "common/problem.h"
#include "common/scene/features.h"
#include "metamer/v1/plan.pb.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// What a worker's machine can do.
struct Capabilities {
  unsigned threads;
  std::string backend = "cpu";          ///< What draws,
  Features features = Features::all();  ///< and what it has.
};

/// Of one tile: about a second's work of a thread.
inline constexpr std::uint64_t max_tile_samples = std::uint64_t{1} << 20;

/// What the scene needs and what will be done, from the compiled scene and its settings
/// (defaults filled in, validated). A pure function; the plan is not changed afterwards.
v1::Plan make_plan(const RenderScene& scene, const v1::Settings& settings,
                   const Capabilities& capabilities);

/// What of it the backend or the method does not have and no picture can do without: empty where
/// there is a plan to make. What it can do without is a notice of the plan.
std::vector<Problem> refusals(const RenderScene& scene, const v1::Settings& settings,
                              const Capabilities& capabilities, bool keep_factors);

}  // namespace metamer
