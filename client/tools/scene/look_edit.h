#pragma once

#include <string>
#include <string_view>

#include "client/tools/scene/look.h"
#include "client/tools/scene/problem_fix.h"

namespace metamer::client {

using SceneLooks = google::protobuf::RepeatedPtrField<v1::Look>;

/// What writes `look` into a scene's text as its look `name`, in the place of the one of that name,
/// else behind all: one edit, which touches no more than it has to, so that comments stay. A text
/// without looks gets `standard` too. What no look can say (spp, a method, an adaptation that is
/// taken away) goes into the scene's own settings. So choose_look of `name` makes of the text's
/// scene what `look` makes of it now. Errors: the text can't be parsed; `look` does not fit it.
Result<TextEdit> look_edit(std::string_view text, const Look& look, const std::string& name,
                           const SceneLooks& standard = {});

}  // namespace metamer::client
