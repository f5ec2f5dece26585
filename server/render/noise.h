#pragma once

#include <optional>

#include "server/render/predict.h"

namespace metamer {

/// ΔE00 of a picture's pixels against what they tend to with more samples, in the colours of
/// `method`: pixels drawn at random are traced again, by other points of lights and lens and
/// other ways between surfaces, and compared with the mean of all. What the place of samples within
/// a pixel decides is no part of it. Nothing: of the plan's picture nothing is sampled so.
std::optional<v1::ColorError> sampling_noise(const PilotScene& pilot, const v1::Plan& plan,
                                             const Method& method, const Xyz& white);

}  // namespace metamer
