#pragma once

#include <string>

#include "metamer/v1/scene.pb.h"

namespace metamer::test {

/// ΔE00 over some colours; white is the light at luminance 1.
struct ColorErrors {
  double mean, worst;
};

/// What a method is off, against f64 sums by 0.05 nm from 360 to 830, in a scene of the 15 test
/// colours of the CIE's colour rendering index under one illuminant: of the colours themselves, and
/// of the 120 that they have in mirrors of each other's colours.
struct MethodErrors {
  ColorErrors direct, bounce;
};
MethodErrors errors_of(const std::string& illuminant, const v1::Method& method);

}  // namespace metamer::test
