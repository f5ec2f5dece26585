#pragma once

#include "server/methods/method.h"

namespace metamer {

/// Point sampling (4.2): a value at each wavelength of the plan.
std::unique_ptr<Method> make_point(const v1::Plan& plan, const RenderScene& scene);

}  // namespace metamer
