#pragma once

#include <string>

#include "common/scene/features.h"
#include "metamer/v1/scene.pb.h"
#include "metamer/v1/session.pb.h"

namespace metamer {

/// "cpu", "gl": as plans and the wire have it.
std::string name_of(v1::Backend backend);

/// Whether a server's backend has it, as Welcome and Info say; where they say nothing, the server
/// tells in answer to a job.
bool has_feature(const v1::Capabilities& capabilities, v1::Backend backend, Feature feature);

}  // namespace metamer
