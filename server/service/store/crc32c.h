#pragma once

#include <isa-l/crc.h>

#include <cstdint>
#include <string_view>

namespace metamer::service {

/// CRC-32C (Castagnoli; RFC 3720) of bytes that follow those of `before`, without the last
/// inversion.
inline std::uint32_t crc32c(std::string_view bytes, std::uint32_t before = ~0u) {
  // It does not write, whatever its declaration says.
  auto* from = reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.data()));
  return crc32_iscsi(from, static_cast<int>(bytes.size()), before);
}

}  // namespace metamer::service
