#pragma once

#include <string>

#include "common/spectral/wavelengths.h"
#include "metamer/v1/plan.pb.h"
#include "server/scene/render_scene.h"

/// What a plan says of methods.
namespace metamer {

/// The bands that a method found where `asked` were asked for at `field`; a notice where they are
/// fewer: "the scene's spectra <verb> no more than 3 <noun>s".
void plan_found(std::size_t found, std::size_t asked, const char* field, const std::string& verb,
                const std::string& noun, v1::Plan& plan);

/// Adds a notice for each light of which the observer sees nothing at these wavelengths: it has
/// power somewhere, and the picture would be dark without a word.
void notice_dark_lights(const RenderScene& scene, const v1::Settings& settings,
                        const Wavelengths& wavelengths, v1::Plan& plan);

}  // namespace metamer
