#pragma once

#include "common/scene/findings.h"
#include "metamer/v1/scene.pb.h"

/// What is wrong with a method's parameters, its defaults filled in. `field` is the member's path.
namespace metamer {

void check_point(const v1::Method& method, const std::string& field, Findings& findings);
void check_linear(const v1::Method& method, const std::string& field, Findings& findings);

/// Of a goal, `field` is its own path.
void check_goal(const v1::Goal& goal, const std::string& field, Findings& findings);

}  // namespace metamer
