#pragma once

#include "server/sandbox/sandbox.h"

namespace metamer::sandbox {

/// Refuses all threads of this process, and what they start, the system calls that it has no use
/// for (EPERM); system_calls.cpp lists them by what they are for. What remains is what a library
/// may need to compute, to wait and to read: the list is of what is refused, since nobody knows
/// what a GL driver calls. Returns 0 or an errno; nothing is changed then.
int refuse_system_calls(Children children);

}  // namespace metamer::sandbox
