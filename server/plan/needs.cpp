#include "server/plan/needs.h"

#include <algorithm>
#include <map>
#include <set>

#include "common/scene/rough_lobe_table.h"
#include "server/methods/exact.h"

namespace metamer {
namespace {

std::string print(const char* format, auto... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string counted(std::size_t count, const std::string& one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

/// "\"gold\"", or "\"gold\" and 2 more".
std::string named(const std::vector<std::string>& names) {
  std::string text = "\"" + names.front() + "\"";
  if (names.size() > 1) text += " and " + std::to_string(names.size() - 1) + " more";
  return text;
}

/// The materials that some object has.
std::vector<const RenderMaterial*> used_materials(const RenderScene& scene) {
  std::vector<const RenderMaterial*> materials;
  for (const std::uint32_t index : seen_materials(scene))
    materials.push_back(&scene.materials[index]);
  return materials;
}

template <class Predicate>
std::vector<std::string> names_of(const std::vector<const RenderMaterial*>& materials,
                                  Predicate predicate) {
  std::vector<std::string> names;
  for (const RenderMaterial* material : materials)
    if (predicate(*material)) names.push_back(material->name);
  return names;
}

/// Where there is light: outside nothing is reflected, whatever the surfaces' data say.
void need_range(const RenderScene& scene, v1::Plan& plan) {
  double from = 1e300, to = 0;
  for (const Spectrum& emission : scene.emissions) {
    const auto lit = [](double value) { return value != 0; };
    const auto first = std::find_if(emission.values.begin(), emission.values.end(), lit);
    if (first == emission.values.end()) continue;
    const auto last = std::find_if(emission.values.rbegin(), emission.values.rend(), lit);
    from = std::min(from, emission.nm[static_cast<std::size_t>(first - emission.values.begin())]);
    to = std::max(to, emission.nm[static_cast<std::size_t>(emission.values.rend() - last) - 1]);
  }
  if (to == 0) return plan.add_unneeded("wavelengths: no light has any power");
  const Wavelengths seen = observer_wavelengths();
  if (to < seen.nm().front() || from > seen.nm().back())
    return plan.add_unneeded(
        print("wavelengths: the lights' power, %g to %g nm, is not seen", from, to));
  plan.add_need(print("wavelengths from %g to %g nm, where the lights have power that is seen",
                      std::max(from, seen.nm().front()), std::min(to, seen.nm().back())));
}

void need_spectra(const RenderScene& scene, v1::Plan& plan) {
  const auto spectra = [](std::size_t count) {
    return std::to_string(count) + (count == 1 ? " spectrum" : " spectra");
  };
  plan.add_need(
      spectra(scene.emissions.size()) + " of lights and " + spectra(scene.properties.size()) +
      " of surfaces: " + counted(direct_signatures(scene), "signature") + " without mirrors");
}

void need_models(const std::vector<const RenderMaterial*>& materials, v1::Plan& plan) {
  std::map<std::string, std::vector<std::string>> users;
  for (const RenderMaterial* material : materials)
    users[models::entry(material->reflection.model).name].push_back(material->name);
  for (const auto& [model, names] : users) plan.add_need("model " + model + ": " + named(names));
  const std::size_t all = models::registry(models::Kind::model).size();
  if (users.size() < all)
    plan.add_unneeded(std::to_string(all - users.size()) + " of " + std::to_string(all) +
                      " models: no object has a material of theirs");
}

void need_fresnel(const std::vector<const RenderMaterial*>& materials, v1::Plan& plan) {
  const auto of = [&](FresnelKind kind) {
    return names_of(materials, [&](const RenderMaterial& m) { return m.fresnel == kind; });
  };
  const auto schlick = of(FresnelKind::schlick), exact = of(FresnelKind::exact);
  if (!schlick.empty())
    plan.add_need("Fresnel terms by Schlick's approximation, two weights: " + named(schlick));
  if (!exact.empty())
    plan.add_need("Fresnel terms of n and k, as a table over the cosine: " + named(exact));
  if (exact.empty()) plan.add_unneeded("Fresnel tables over the cosine: no material has n and k");
}

void need_rough_lobes(const std::vector<const RenderMaterial*>& materials, v1::Plan& plan) {
  const auto rough =
      names_of(materials, [](const RenderMaterial& m) { return m.has(models::diffracting); });
  if (!rough.empty())
    plan.add_need(print("lobes that depend on wavelength for their geometry, at %u wavelengths: ",
                        static_cast<unsigned>(lobe_wavelengths)) +
                  named(rough));
}

void need_fluorescence(const std::vector<const RenderMaterial*>& materials, v1::Plan& plan) {
  const auto bright =
      names_of(materials, [](const RenderMaterial& m) { return m.fluorescence.has_value(); });
  if (!bright.empty())
    plan.add_need("fluorescence, as a light of its own for each light: " + named(bright));
}

void need_rays(const RenderScene& scene, const std::vector<const RenderMaterial*>& materials,
               const Capabilities& capabilities, v1::Plan& plan) {
  const auto mirrors = names_of(materials, [](const RenderMaterial& m) { return m.mirror > 0; });
  if (mirrors.empty())
    plan.add_unneeded("mirror rays: no material mirrors");
  else if (!capabilities.features.has(Feature::mirrors))
    plan.add_unneeded("mirror rays: the " + capabilities.backend + " backend has none, although " +
                      named(mirrors) + " mirrors");
  else if (plan.depth() == 0)
    plan.add_unneeded("mirror rays: the settings allow none, although " + named(mirrors) +
                      " mirrors");
  else
    plan.add_need(print("up to %u mirror reflections a path: ", plan.depth()) + named(mirrors));

  const auto clear = names_of(materials, [](const RenderMaterial& m) { return m.medium > 0; });
  if (clear.empty())
    plan.add_unneeded("ray trees: no material lets light through");
  else if (!capabilities.features.has(Feature::transmission))
    plan.add_unneeded("ray trees: the " + capabilities.backend + " backend has none, although " +
                      named(clear) + " lets light through");
  else if (plan.depth() == 0)
    plan.add_unneeded("ray trees: the settings allow none, although " + named(clear) +
                      " lets light through");
  else
    plan.add_need(print("ray trees of up to %u reflections and refractions, down to %g of a "
                        "sample's weight: ",
                        plan.depth(), plan.cutoff()) +
                  named(clear));
  if (!clear.empty() && capabilities.features.has(Feature::transmission))
    plan.add_need(print("%u interfaces of clear materials, as tables over the cosine: ",
                        static_cast<unsigned>(scene.interfaces.size())) +
                  named(clear));

  if (!scene.windows.empty())
    plan.add_need(print("%u bundles of wavelengths, each with a way of its own behind the first "
                        "surface that disperses: ",
                        static_cast<unsigned>(scene.windows.size())) +
                  named(names_of(materials, [&](const RenderMaterial& m) {
                    return m.medium > 0 && scene.media[m.medium].dispersion;
                  })));
  else
    plan.add_unneeded("bundles of wavelengths: no material disperses light");

  if (plan.bounces() > 0)
    plan.add_need(print("up to %u diffuse reflections between surfaces a path, by %u rays a sample",
                        plan.bounces(), plan.bounce_samples()));
  else
    plan.add_unneeded("light that surfaces reflect to each other: the settings allow none");

  const auto bent = names_of(materials, [](const RenderMaterial& m) { return m.anisotropic(); });
  if (bent.empty())
    plan.add_unneeded("tangents: no material is anisotropic");
  else
    plan.add_need("tangents: " + named(bent));

  const auto pictured = names_of(materials, [](const RenderMaterial& m) { return m.texture; });
  if (pictured.empty())
    plan.add_unneeded("textures: no material has one");
  else
    plan.add_need("textures, looked up at each sample: " + named(pictured));

  const auto turned =
      names_of(materials, [](const RenderMaterial& m) { return m.turns_normals(); });
  if (turned.empty())
    plan.add_unneeded("normal and bump maps: no material has one");
  else
    plan.add_need("normals by pictures, looked up at each sample: " + named(turned));
  const auto holed =
      names_of(materials, [](const RenderMaterial& m) { return m.alpha.has_value(); });
  if (holed.empty())
    plan.add_unneeded("paths through what is not all there: no material has alpha");
  else
    plan.add_need(print("paths through what is not all there, down to %g of a sample's weight: ",
                        plan.cutoff()) +
                  named(holed));

  std::vector<std::string> cornered;
  for (const RenderObject& object : scene.objects)
    if (object.shading != v1::PHONG && object.shape == RenderObject::Shape::mesh)
      cornered.push_back(object.name);
  if (cornered.empty())
    plan.add_unneeded("models at the triangles' corners: every object is shaded by PHONG");
  else
    plan.add_need("models at the triangles' corners or middles: " + named(cornered));
}

}  // namespace

void list_needs(const RenderScene& scene, const Capabilities& capabilities, v1::Plan& plan) {
  const auto materials = used_materials(scene);
  need_range(scene, plan);
  need_spectra(scene, plan);
  need_models(materials, plan);
  need_fresnel(materials, plan);
  need_rough_lobes(materials, plan);
  need_fluorescence(materials, plan);
  need_rays(scene, materials, capabilities, plan);
  if (materials.size() < scene.materials.size())
    plan.add_unneeded(counted(scene.materials.size() - materials.size(), "material") +
                      ": no object has them");
}

}  // namespace metamer
