#pragma once

#include <filesystem>

namespace metamer::service {

/// Room on the state's disk that the daemon keeps, by a file of zeros, for what has to be possible
/// on a full one: `metamerd user revoke` gives it up and writes a few pages in its place.
///
/// Makes it where it is missing. Where there is no room for it there is none: that is no error.
void keep_reserve(const std::filesystem::path& state);
/// False: there was none.
bool give_up_reserve(const std::filesystem::path& state);

}  // namespace metamer::service
