#pragma once

#include <string>
#include <vector>

#include "metamer/v1/scene.pb.h"

namespace metamer::test {

/// Lights are sampled, as in the source.
v1::Method uniform(double from, double to, double step);
v1::Method cells(double from, double to, double step);
v1::Method listed(const std::vector<double>& nm);
v1::Method fitted(std::uint32_t count);
v1::Method linear(std::uint32_t bases, v1::Linear::Weighting weighting = v1::Linear::NONE,
                  bool bounce = false);
v1::Method prefilter();
v1::Method rgb();
v1::Method exact();

/// Every method with the ends and the middle of its parameters, for laws that all must keep.
std::vector<v1::Method> all_methods();

}  // namespace metamer::test
