#pragma once

#include "server/methods/method.h"

namespace metamer {

/// No paper: X, Y and Z each by itself, a surface as it is under equal energy.
std::unique_ptr<Method> make_toy(const v1::Plan& plan, const RenderScene& scene);

}  // namespace metamer
