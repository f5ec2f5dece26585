#pragma once

#include <cstdint>

namespace metamer::wire {

/// The most that all factors of a job's picture take: ten times those of a 4K picture without
/// clear things.
inline constexpr std::uint64_t max_picture_factors = std::uint64_t{4} << 30;

}  // namespace metamer::wire
