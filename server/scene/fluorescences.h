#pragma once

#include <vector>

#include "common/scene/validate.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Gives a scene that is otherwise compiled its fluorescences, and what they make of its lights as
/// its observer sees them; and notices: from where lights count for them, which lights have no data
/// there, which fluorescences no light reaches. Errors: those of load_fluorescence; more light out
/// than in; more than limits::max_reradiated or max_bispectral_cells.
std::vector<Problem> add_fluorescences(const v1::Scene& message, const AssetReader& assets,
                                       RenderScene& scene);

}  // namespace metamer
