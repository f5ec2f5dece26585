#pragma once

#include <cstdint>

namespace metamer::wire {

/// The version of the protocol that this code speaks: what Hello and Welcome carry. It rises when
/// an older peer would misunderstand; new fields and new messages alone do not raise it.
inline constexpr std::uint32_t protocol_version = 1;

}  // namespace metamer::wire
