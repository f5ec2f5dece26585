#pragma once

#include <map>
#include <string>
#include <vector>

#include "client/relight/factors.h"
#include "common/spectral/cie.h"

/// Other light and other paint for a kept picture: what is given to relight.
namespace metamer::client {

/// A reflectance of a material.
struct Property {
  int material;  ///< Its place in the scene's list.
  v1::FactorTerm term;
};

/// By NAME.diffuse and NAME.specular; NAME alone is the diffuse one. A material whose name is
/// another's with such an ending hides that property.
std::map<std::string, Property> properties_of(const v1::SceneFactors& scene);

/// Whether any pixel shows a property.
bool is_shown(const Property& property, const v1::TileFactors& tables);

/// Gives the lights of that name, "*": all of them, another power.
void swap_light(const std::string& name, const Spectrum& power, v1::SceneFactors& scene);

/// Gives a material another reflectance, which lies in 0..1.
void swap_reflectance(const Property& property, const Spectrum& reflectance,
                      v1::SceneFactors& scene);

/// Lets another observer see the picture, which the plan and the scene then name.
void swap_observer(const Observer& observer, v1::SceneFactors& scene, v1::Plan& plan);

/// Makes the plan that a picture was rendered by that of one which is relit: by the method `exact`,
/// with the source white of the scene's first light to observer_of.
void plan_relit(const v1::SceneFactors& scene, v1::Plan& plan);

}  // namespace metamer::client
