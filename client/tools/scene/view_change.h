#pragma once

#include <optional>

#include "metamer/v1/scene.pb.h"
#include "metamer/v1/views.pb.h"

namespace metamer::client {

/// What a view that shows one scene has to be told to show another: camera, lights, materials and
/// settings that differ. Nothing: that is not enough, as objects, the lists of names, or the
/// backend differ; the view has to be opened anew. Takes time by the size of both.
std::optional<v1::UpdateView> view_change(const v1::Scene& shown, const v1::Scene& wanted);

}  // namespace metamer::client
