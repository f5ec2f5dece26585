#pragma once

#include "common/problem.h"
#include "common/spectral/cie.h"
#include "common/spectral/wavelengths.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

/// Moves a goal that stands in method.auto, where scenes had it before, to its place. Where a
/// method or a goal is there too, nothing changes: check_settings says so.
void take_older_goal(v1::Settings& settings);

/// The settings with every default of scene.proto filled in, those of the goal and the method
/// included; with a goal, none is the method. A goal stands in its place (take_older_goal).
v1::Settings with_defaults(const v1::Settings& settings);

/// The positions of a point method whose defaults are filled in; not of one that is fitted.
Result<Wavelengths> point_wavelengths(const v1::Point& point);

/// Of the CIE's; not that of an observer_file.
const Observer& to_observer(v1::Observer observer);

}  // namespace metamer
