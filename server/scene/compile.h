#pragma once

#include <atomic>
#include <vector>

#include "common/problem.h"
#include "common/scene/validate.h"
#include "metamer/v1/scene.pb.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Builds the flat scene: validates the message again (clients may lie), resolves names, loads each
/// spectrum and mesh once. Errors: everything that is wrong, each with its field path. `cancelled`
/// is looked at between assets; the result is then an empty list of problems.
tl::expected<RenderScene, std::vector<Problem>> compile_scene(const v1::Scene& scene,
                                                              const AssetReader& assets,
                                                              const std::atomic<bool>& cancelled);

}  // namespace metamer
