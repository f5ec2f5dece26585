#include "client/tools/pictures/relit.h"

#include "client/relight/relight.h"
#include "client/tools/scene/words.h"

namespace metamer::client {
namespace {

void set(const Spectrum& spectrum, v1::SampledSpectrum& to) {
  to.mutable_nm()->Assign(spectrum.nm.begin(), spectrum.nm.end());
  to.mutable_values()->Assign(spectrum.values.begin(), spectrum.values.end());
}

}  // namespace

std::map<std::string, Property> properties_of(const v1::SceneFactors& scene) {
  std::map<std::string, Property> properties;
  for (int i = 0; i < scene.material_size(); ++i) {
    const std::string& name = scene.material(i).name();
    properties[name + ".specular"] = {i, v1::FACTOR_SPECULAR};
    properties[name + ".diffuse"] = {i, v1::FACTOR_DIFFUSE};
  }
  for (int i = 0; i < scene.material_size(); ++i)
    properties[scene.material(i).name()] = {i, v1::FACTOR_DIFFUSE};
  return properties;
}

bool is_shown(const Property& property, const v1::TileFactors& tables) {
  const auto material = static_cast<std::uint32_t>(property.material);
  for (int i = 0; i < tables.signature_term_size(); ++i)
    if (tables.signature_material(i) == material && tables.signature_term(i) == property.term)
      return true;
  for (int i = 0; i < tables.product_term_size(); ++i)
    if (tables.product_material(i) == material && tables.product_term(i) == property.term)
      return true;
  return false;
}

void swap_light(const std::string& name, const Spectrum& power, v1::SceneFactors& scene) {
  for (auto& light : *scene.mutable_light())
    if (name == "*" || name == light.name()) set(power, *light.mutable_power());
}

void swap_reflectance(const Property& property, const Spectrum& reflectance,
                      v1::SceneFactors& scene) {
  auto& material = *scene.mutable_material(property.material);
  set(reflectance, property.term == v1::FACTOR_DIFFUSE ? *material.mutable_diffuse()
                                                       : *material.mutable_specular());
}

void swap_observer(const Observer& observer, v1::SceneFactors& scene, v1::Plan& plan) {
  const auto cie = observer_named(observer.name());
  plan.set_observer(cie.value_or(v1::CIE_1931_2DEG));
  plan.set_observer_file(cie ? std::string() : observer.name());
  scene.clear_observer();
  for (const Spectrum& function : observer.functions()) set(function, *scene.add_observer());
}

void plan_relit(const v1::SceneFactors& scene, v1::Plan& plan) {
  plan.clear_source_white();
  if (const auto white = source_white(scene, observer_of(plan, scene)))
    for (const double value : *white) plan.add_source_white(value);
  plan.clear_auto_();
  plan.mutable_method()->mutable_exact();
}

}  // namespace metamer::client
