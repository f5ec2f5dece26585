#include "server/plan/features.h"

#include <algorithm>

namespace metamer {
namespace {

/// What becomes of a need that `by`, "gl backend", does not support.
struct Lack {
  enum class Kind { notice, refusal } kind;
  std::string message;
};

Lack lack(Feature feature, const std::string& by) {
  using enum Lack::Kind;
  switch (feature) {
    case Feature::mirrors:
      return {notice, "the " + by + " has no mirrors"};
    case Feature::exact_fresnel:
      return {refusal, "the " + by + " has no Fresnel terms of n and k"};
    case Feature::anisotropy:
      return {refusal, "the " + by + " has no tangents for anisotropic models"};
    case Feature::corner_shading:
      return {notice, "the " + by + " shades by PHONG alone"};
    case Feature::factors:
      return {refusal, "the " + by + " keeps no factors for relighting"};
    case Feature::textures:
      return {refusal, "the " + by + " has no textures"};
    case Feature::area_lights:
      return {refusal, "the " + by + " has no lights with a surface"};
    case Feature::environment:
      return {refusal, "the " + by + " has no light from all around"};
    case Feature::planes:
      return {refusal, "the " + by + " has no planes out to the horizon"};
    case Feature::multi_pass:
      return {notice, "has no effect: the " + by + " has no passes"};
    case Feature::transmission:
      return {refusal, "the " + by + " has no refraction"};
    case Feature::inter_reflection:
      return {notice, "the " + by + " has no light that surfaces reflect to each other"};
    case Feature::normal_maps:
      return {refusal, "the " + by + " has no normal or bump maps"};
    case Feature::alpha:
      return {refusal, "the " + by + " shows surfaces as a whole, without alpha"};
    case Feature::fluorescence:
      return {refusal, "the " + by + " has no fluorescence"};
    case Feature::lens:
      return {refusal, "the " + by + " has no lens: its camera is a pinhole"};
  }
  return {refusal, {}};
}

std::string element(const char* list, std::size_t i) {
  std::string text = list;
  text += '[';
  text += std::to_string(i);
  return text + ']';
}

/// Of objects, whose `part` it is that needs it.
template <class Predicate>
void need_of_objects(const RenderScene& scene, Feature feature, const char* part,
                     Predicate needs_it, std::vector<Need>& needs) {
  Need need{feature, {}, 0};
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (needs_it(scene.objects[i]) && need.count++ == 0) need.field = element("object", i) + part;
  if (need.count > 0) needs.push_back(need);
}

/// Of materials that objects have, in the objects' order.
template <class Predicate>
void need_of_materials(const RenderScene& scene, Feature feature, const char* part,
                       Predicate needs_it, std::vector<Need>& needs) {
  Need need{feature, {}, 0};
  std::vector<bool> seen(scene.materials.size());
  for (const RenderObject& object : scene.objects) {
    if (seen[object.material] || !needs_it(scene.materials[object.material])) continue;
    seen[object.material] = true;
    if (need.count++ == 0) need.field = element("material", object.material) + part;
  }
  if (need.count > 0) needs.push_back(need);
}

void need_of_area_lights(const RenderScene& scene, std::vector<Need>& needs) {
  using Source = RenderLight::Source;
  Need need{Feature::area_lights, {}, 0};
  for (const RenderLight& light : scene.lights)
    if ((light.source == Source::surface || light.source == Source::object) && need.count++ == 0)
      need.field = light.field;
  if (need.count > 0) needs.push_back(need);
}

}  // namespace

std::vector<Need> features_of(const RenderScene& scene, const v1::Settings& settings) {
  using Object = RenderObject;
  using Material = RenderMaterial;
  std::vector<Need> needs;
  need_of_materials(
      scene, Feature::mirrors, ".mirror",
      [&](const Material& m) { return settings.depth() > 0 && m.mirror > 0; }, needs);
  need_of_materials(
      scene, Feature::exact_fresnel, ".fresnel",
      [](const Material& m) { return m.fresnel == FresnelKind::exact; }, needs);
  need_of_materials(
      scene, Feature::anisotropy, "", [](const Material& m) { return m.anisotropic(); }, needs);
  need_of_materials(
      scene, Feature::textures, ".texture", [](const Material& m) { return m.texture.has_value(); },
      needs);
  need_of_materials(
      scene, Feature::normal_maps, "", [](const Material& m) { return m.turns_normals(); }, needs);
  need_of_materials(
      scene, Feature::alpha, ".alpha", [](const Material& m) { return m.alpha.has_value(); },
      needs);
  need_of_objects(
      scene, Feature::corner_shading, "",
      [](const Object& object) {
        return object.shape == Object::Shape::mesh && object.shading != v1::PHONG;
      },
      needs);
  need_of_materials(
      scene, Feature::transmission, ".transmission", [](const Material& m) { return m.medium > 0; },
      needs);
  need_of_objects(
      scene, Feature::planes, ".plane",
      [](const Object& object) { return object.shape == Object::Shape::plane; }, needs);
  need_of_area_lights(scene, needs);
  if (scene.environment) needs.push_back({Feature::environment, scene.environment->field});
  need_of_materials(
      scene, Feature::fluorescence, ".fluorescence",
      [](const Material& m) { return m.fluorescence.has_value(); }, needs);
  if (scene.camera.aperture_radius > 0) needs.push_back({Feature::lens, "camera.aperture_radius"});
  if (settings.bounces() > 0) needs.push_back({Feature::inter_reflection, "settings.bounces"});
  if (settings.method().point().multi_pass())
    needs.push_back({Feature::multi_pass, "settings.method.point.multi_pass"});
  return needs;
}

Need need_of_factors() { return {Feature::factors, {}}; }

void notice_unsupported(const std::vector<Need>& needs, const Supported& supported,
                        v1::Plan& plan) {
  for (const Need& need : needs) {
    const Lack lacking = lack(need.feature, supported.by);
    if (supported.features.has(need.feature) || lacking.kind != Lack::Kind::notice) continue;
    v1::Notice& notice = *plan.add_notice();
    notice.set_field(need.field);
    notice.set_message(lacking.message + (need.count > 1
                                              ? " (and " + std::to_string(need.count - 1) + " more)"
                                              : ""));
  }
}

std::vector<Problem> refuse_unsupported(const std::vector<Need>& needs,
                                        const Supported& supported) {
  std::vector<Problem> problems;
  for (const Need& need : needs) {
    const Lack lacking = lack(need.feature, supported.by);
    if (!supported.features.has(need.feature) && lacking.kind == Lack::Kind::refusal)
      problems.push_back({.field = need.field, .file = {}, .message = lacking.message});
  }
  return problems;
}

}  // namespace metamer
