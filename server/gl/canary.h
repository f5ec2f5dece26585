#pragma once

#include "common/problem.h"
#include "metamer/v1/session.pb.h"
#include "server/gl/context.h"

namespace metamer::gl {

/// What a device is and what it can be relied on for; the context is current. Drivers are not asked
/// but tried: llvmpipe leaves loops after 65,535 iterations without a word, and its timers are
/// wrong. Errors: loops that end before 32,000 iterations.
Result<v1::GlCapabilities> examine(const Context& context);

}  // namespace metamer::gl
