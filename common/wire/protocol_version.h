#pragma once

#include <cstdint>

namespace metamer::wire {

/// What Hello and Welcome carry. It grows when a peer of the version before would misunderstand;
/// fields that may be ignored do not make it grow.
inline constexpr std::uint32_t protocol_version = 1;

}  // namespace metamer::wire
