#pragma once

#include <string>
#include <vector>

#include "client/cli/options.h"
#include "common/problem.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::cli {

/// A part of the scene that the command line replaced: a problem there is the option's.
struct Replaced {
  std::string field;   ///< "settings.spp"
  std::string option;  ///< "--spp"
};

/// Puts the options in the place of the scene's settings. Whether the values make sense is
/// validate_scene's business; an error here is one of syntax, or names what does not exist.
Result<std::vector<Replaced>> apply(const Overrides& overrides, v1::Scene& scene);

/// One of the options says by which method.
bool choose_a_method(const Overrides& overrides);

/// The option that the field belongs to; empty when it is the scene's own.
std::string option_of(const std::vector<Replaced>& replaced, const std::string& field);

}  // namespace metamer::cli
