#pragma once

#include <string>

#include "common/color/sunlight.h"
#include "common/scene/findings.h"

namespace metamer {

/// Adds what is wrong with a sunlight or a sky: turbidity and elevation out of their ranges.
template <class Day>
void check_day(const Day& day, const std::string& field, Findings& findings) {
  if (day.has_turbidity())
    check_range(day.turbidity(), least_turbidity, most_turbidity, field + ".turbidity", findings);
  if (day.has_elevation())
    check_range(day.elevation(), 0, most_elevation, field + ".elevation", findings);
}

}  // namespace metamer
