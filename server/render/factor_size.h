#pragma once

#include <atomic>
#include <cstdint>

#include "metamer/v1/plan.pb.h"
#include "server/render/probe.h"

namespace metamer {

/// What the factors of a picture take that is to be relit (FactorSink), by pixels of its plan.
struct FactorSize {
  double pixel = 0;  ///< Bytes, of the pixel that has most; infinite: more than FactorSink counts.
  double mean = 0;   ///< Bytes a pixel.

  /// The side of tiles, the plan's or 8, of which no more than `most` bytes are expected; 0: of
  /// neither.
  std::uint32_t tile_size(const v1::Plan& plan, double most) const;
};

/// Traces as many pixels as a pilot does. The probe is prepared.
FactorSize factor_size(const Probe& probe, const v1::Plan& plan, const std::atomic<bool>& stopped,
                       std::atomic<std::uint64_t>& work);

}  // namespace metamer
