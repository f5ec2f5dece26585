#pragma once

#include "metamer/v1/plan.pb.h"
#include "server/methods/method.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// ΔE00 below which nothing is said.
inline constexpr double unnoticed_difference = 0.3;

/// Adds a notice for each light of which the method gets the white, or a material under it, wrong
/// by more than unnoticed_difference, and for each that stays dark although it has power.
void notice_colors(const RenderScene& scene, const Method& method, v1::Plan& plan);

/// Adds a notice for each spectrum whose data end where it matters: an emission whose white would
/// change by more than unnoticed_difference if it went on as it ends, and a property beyond whose
/// data more than 1 % of what is seen of a light lies; and for an observer whose data end early.
void notice_ends_of_data(const RenderScene& scene, v1::Plan& plan);

}  // namespace metamer
