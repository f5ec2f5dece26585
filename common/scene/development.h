#pragma once

#include "common/color/adaptation.h"
#include "common/color/rgb_space.h"
#include "common/problem.h"
#include "metamer/v1/plan.pb.h"

/// The messages of a development as the colour library's own values.
namespace metamer {

/// The message's values are known.
Adaptation to_adaptation(v1::Adaptation adaptation);
StandardSpace to_standard_space(v1::RgbSpace space);

/// The space that a development names, sRGB when it names none. Errors, with the field inside the
/// development ("primaries.red"): those of make_rgb_space, a chromaticity that has not two numbers.
Result<RgbSpace> to_rgb_space(const v1::Development& development);

/// How a plan's X Y Z become RGB.
struct PlannedDevelopment {
  RgbSpace space;
  /// X Y Z as rendered → as seen under the white of the space, as bright as the picture is to be.
  Matrix3 adaptation = identity3;
  std::string unadapted;  ///< Why the adaptation that was asked for can't be done; empty: it can.
  /// What the space's white makes of D65 where nothing else becomes that white; empty: it is D65.
  std::string shown_white;
};

/// Where no adaptation is asked for, or the one that is can't be done, D65 becomes the white of the
/// space, so that viewers that go by it show the picture as in sRGB; NO_ADAPTATION leaves X Y Z as
/// they are. Error: a space that there can't be.
Result<PlannedDevelopment> planned_development(const v1::Plan& plan);

}  // namespace metamer
