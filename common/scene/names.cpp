#include "common/scene/names.h"

#include "common/scene/findings.h"

namespace metamer {

bool has_extension(std::string_view name, std::string_view extension) {
  if (name.size() < extension.size()) return false;
  name.remove_prefix(name.size() - extension.size());
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i] >= 'A' && name[i] <= 'Z' ? static_cast<char>(name[i] + 32) : name[i];
    if (c != extension[i]) return false;
  }
  return true;
}

namespace {

using SpectrumVisit =
    std::function<void(const v1::Spectrum&, const std::string& field, SpectrumRole)>;

void for_each_spectrum(const v1::Look& look, const std::string& field, const SpectrumVisit& visit) {
  for (int i = 0; i < look.light_size(); ++i)
    if (look.light(i).has_spectrum())
      visit(look.light(i).spectrum(),
            indexed(field + ".light", static_cast<std::size_t>(i)) + ".spectrum",
            SpectrumRole::emission);
  for (int i = 0; i < look.material_size(); ++i) {
    const v1::LookMaterial& material = look.material(i);
    const std::string place = indexed(field + ".material", static_cast<std::size_t>(i));
    if (material.has_diffuse())
      visit(material.diffuse(), place + ".diffuse", SpectrumRole::property);
    if (material.has_specular())
      visit(material.specular(), place + ".specular", SpectrumRole::property);
  }
}

}  // namespace

void for_each_spectrum(
    const v1::Scene& scene,
    const std::function<void(const v1::Spectrum&, const std::string&, SpectrumRole)>& visit) {
  for (int i = 0; i < scene.light_size(); ++i) {
    const v1::Light& light = scene.light(i);
    const std::string field = indexed("light", static_cast<std::size_t>(i));
    if (light.has_spectrum()) visit(light.spectrum(), field + ".spectrum", SpectrumRole::emission);
  }
  for (int i = 0; i < scene.material_size(); ++i) {
    const v1::Material& material = scene.material(i);
    const std::string field = indexed("material", static_cast<std::size_t>(i));
    if (material.has_diffuse())
      visit(material.diffuse(), field + ".diffuse", SpectrumRole::property);
    if (material.has_specular()) {
      visit(material.specular(), field + ".specular", SpectrumRole::property);
    }
    for (int s = 0; s < material.texture().spectrum_size(); ++s)
      visit(material.texture().spectrum(s),
            indexed(field + ".texture.spectrum", static_cast<std::size_t>(s)),
            SpectrumRole::property);
    const v1::Fluorescence& fluorescence = material.fluorescence();
    if (fluorescence.has_excitation())
      visit(fluorescence.excitation(), field + ".fluorescence.excitation",
            SpectrumRole::excitation);
    if (fluorescence.has_emission())
      visit(fluorescence.emission(), field + ".fluorescence.emission", SpectrumRole::emission);
    const v1::Dielectric& dielectric = material.fresnel().dielectric();
    const std::string below = field + ".fresnel.";
    if (dielectric.has_n()) visit(dielectric.n(), below + "dielectric.n", SpectrumRole::index);
    if (dielectric.has_reflectance()) {
      visit(dielectric.reflectance(), below + "dielectric.reflectance", SpectrumRole::reflectance);
    }
    const v1::Conductor& conductor = material.fresnel().conductor();
    if (conductor.has_n()) visit(conductor.n(), below + "conductor.n", SpectrumRole::index);
    if (conductor.has_k()) visit(conductor.k(), below + "conductor.k", SpectrumRole::extinction);
    if (material.transmission().has_transmittance())
      visit(material.transmission().transmittance(), field + ".transmission.transmittance",
            SpectrumRole::property);
  }
  for (int i = 0; i < scene.look_size(); ++i)
    for_each_spectrum(scene.look(i), indexed("look", static_cast<std::size_t>(i)), visit);
}

void for_each_bispectral_file(
    const v1::Scene& scene,
    const std::function<void(const std::string& file, const std::string& field)>& visit) {
  for (int i = 0; i < scene.material_size(); ++i)
    if (const std::string& file = scene.material(i).fluorescence().file(); !file.empty())
      visit(file, indexed("material", static_cast<std::size_t>(i)) + ".fluorescence.file");
}

void for_each_observer_file(
    const v1::Scene& scene,
    const std::function<void(const std::string& file, const std::string& field)>& visit) {
  if (!scene.settings().observer_file().empty())
    visit(scene.settings().observer_file(), "settings.observer_file");
  for (int i = 0; i < scene.look_size(); ++i)
    if (!scene.look(i).observer_file().empty())
      visit(scene.look(i).observer_file(),
            indexed("look", static_cast<std::size_t>(i)) + ".observer_file");
}

}  // namespace metamer
