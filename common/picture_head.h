#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace metamer {

/// Of a picture's file, all that its size is looked for in: an EXR of 800 channels still has it.
inline constexpr std::size_t picture_head_bytes = 64u << 10;

/// Whether the first eight bytes are those of a PNG or an EXR.
bool begins_picture(std::string_view head);

/// The numbers that a picture has in memory at a time when it is read whole, at most, by what its
/// file of `file_bytes` begins with: IHDR of a PNG (3rd edition, 11.2.1), the channels and windows
/// of an EXR ("OpenEXR File Layout"). Bounded by what is read at all, whatever the file says: 256
/// Mi of a PNG, no more than deflate makes of its bytes; 64 Mi of an EXR, of which no more than 32
/// channels count. 0: `head` is of neither, or ends before it says it.
std::uint64_t picture_values(std::string_view head, std::uint64_t file_bytes);

}  // namespace metamer
