#pragma once

#include "client/relight/factors.h"
#include "common/scene/validate.h"

/// What a kept picture becomes when its scene is given another look.
namespace metamer::client {

/// What is given to relight, and the plan of what comes of it.
struct RelitScene {
  v1::SceneFactors scene;
  v1::Plan plan;
};

/// Light, paint, observer and development of `wanted` for a picture that was rendered of
/// `rendered`. Of the settings only these count. `assets` reads the files of `wanted`. Errors: what
/// else differs, which factors do not know; a spectrum or an observer that can't be read.
Result<RelitScene> relit_scene(const Factors& factors, const v1::Scene& rendered,
                               const v1::Scene& wanted, const AssetReader& assets);

/// Whether two scenes are the same in all that relit_scene changes.
bool same_look(const v1::Scene& one, const v1::Scene& other);

}  // namespace metamer::client
