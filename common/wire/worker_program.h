#pragma once

#include <filesystem>
#include <string>

namespace metamer::wire {

/// SHA-256, in hex, that tells whether a worker is the one that rendered a job's tiles: two
/// programs may differ in the last bit. Empty where it can't be read.
std::string digest_of_program(const std::filesystem::path& program);

}  // namespace metamer::wire
