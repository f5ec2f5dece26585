#pragma once

#include "common/scene/light.h"

namespace metamer {

/// A light's parameters, with defaults filled in, as RenderLight has them: directions unit, angles
/// as 1 − cosine.
lights::Values<double> light_parameters(const ChosenLight& light);

}  // namespace metamer
