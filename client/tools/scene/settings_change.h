#pragma once

#include <string>

#include "client/tools/scene/look.h"

namespace metamer::client {

/// Makes the look's settings those that turn a scene's `own` into `wanted`, whatever it set of them
/// before: a field that differs counts, also one that is left out now. Where `wanted` names neither
/// method nor goal, or no space of its development, and `own` does, the default is named, as a look
/// takes no choice away. Both are valid by check_settings. `by` is who says so.
void set_settings(const v1::Settings& own, v1::Settings wanted, const std::string& by, Look& look);

}  // namespace metamer::client
