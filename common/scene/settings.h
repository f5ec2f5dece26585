#pragma once

#include "common/problem.h"
#include "common/spectral/cie.h"
#include "common/spectral/wavelengths.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

/// The settings with every default of scene.proto filled in, the method included.
v1::Settings with_defaults(const v1::Settings& settings);

/// The positions of a point method whose defaults are filled in; not of one that is fitted.
Result<Wavelengths> point_wavelengths(const v1::Point& point);

cie::Observer to_observer(v1::Observer observer);

}  // namespace metamer
