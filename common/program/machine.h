#pragma once

#include <string>

namespace metamer {

/// This machine's name, as the kernel has it.
std::string host_name();

/// The processor's name, as the kernel has it; empty where it says none.
std::string processor_name();

}  // namespace metamer
