#pragma once

#include <string>
#include <vector>

#include "client/cli/shared_options.h"
#include "client/tools/scene/look.h"
#include "common/problem.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::cli {

/// What the options but --look change of a scene, each part by the name of its option. Errors are
/// those of syntax and of words that name nothing.
Result<client::Look> look_of(const Overrides& overrides);

/// Puts the scene's look of --look and then the options in the place of what the scene says.
/// Whether the values make sense is validate_scene's business; other errors than look_of's: a look
/// or a light that is not there, an option for another method than the scene's.
Result<std::vector<client::Replaced>> apply(const Overrides& overrides, v1::Scene& scene);

/// One of the options says by which method.
bool choose_a_method(const Overrides& overrides);

}  // namespace metamer::cli
