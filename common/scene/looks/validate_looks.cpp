#include "common/scene/looks/validate_looks.h"

#include <map>
#include <string>

#include "common/scene/check_spectrum.h"
#include "common/scene/limits.h"
#include "common/scene/part_names.h"
#include "common/scene/parts.h"

namespace metamer {
namespace {

/// Checks the looks of one scene.
class LookCheck {
 public:
  explicit LookCheck(const v1::Scene& scene) {
    // What is wrong with the scene's own names is validate_scene's business.
    Findings ignored;
    for (int i = 0; i < scene.light_size(); ++i)
      lights_.take(scene.light(i).name(), static_cast<std::size_t>(i), ignored);
    for (int i = 0; i < scene.material_size(); ++i)
      materials_.take(scene.material(i).name(), static_cast<std::size_t>(i), ignored);
  }

  void check(const v1::Look& look, std::size_t index) {
    const std::string field = indexed("look", index);
    if (look.name().empty()) findings_.add(field, "look needs a name");
    looks_.take(look.name(), index, findings_);
    if (!check_values(look, field, findings_)) return;
    changes(look.light(), field + ".light",
            [&](const v1::LookLight& light, const auto& place) { check_change(light, place); });
    changes(look.material(), field + ".material",
            [&](const v1::LookMaterial& material, const auto& place) {
              check_change(material, place);
            });
    if (look.has_observer() && !look.observer_file().empty())
      findings_.add(
          field + ".observer_file",
          "an observer_file takes the place of observer, which is given too: leave out one");
    check_development(look.development(), field + ".development", findings_);
    if (look.has_camera()) check_camera(look.camera(), field + ".camera", findings_);
  }

  Findings& findings() { return findings_; }

 private:
  /// Calls `check` for each change, and finds names that are changed twice.
  template <class Changes, class Check>
  void changes(const Changes& all, const std::string& field, Check check) {
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < static_cast<std::size_t>(all.size()); ++i) {
      const auto& change = all[static_cast<int>(i)];
      const std::string place = indexed(field, i);
      check(change, place);
      const auto [known, is_new] = first.try_emplace(change.name(), i);
      if (!is_new)
        findings_.add(place + ".name", quoted(change.name()) + " is changed twice (first by " +
                                           indexed(field, known->second) + ")");
    }
  }

  void check_change(const v1::LookLight& light, const std::string& field) {
    if (light.name().empty())
      findings_.add(field, "a look's light needs the name of a light of the scene, or \"*\"");
    else if (light.name() != "*")
      lights_.check_known(light.name(), field + ".name", findings_);
    if (light.has_spectrum())
      check_spectrum(light.spectrum(), field + ".spectrum", SpectrumRole::emission, findings_);
    else if (!light.has_luminance())
      findings_.add(field, "a look's light needs a spectrum or a luminance");
    check_luminance(light.luminance(), field + ".luminance", findings_);
  }

  void check_change(const v1::LookMaterial& material, const std::string& field) {
    if (material.name().empty())
      findings_.add(field, "a look's material needs the name of a material of the scene");
    else
      materials_.check_known(material.name(), field + ".name", findings_);
    if (material.has_diffuse())
      check_spectrum(material.diffuse(), field + ".diffuse", SpectrumRole::property, findings_);
    if (material.has_specular())
      check_spectrum(material.specular(), field + ".specular", SpectrumRole::property, findings_);
    if (!material.has_diffuse() && !material.has_specular())
      findings_.add(field, "a look's material needs a diffuse or a specular");
  }

  PartNames looks_{"look"}, lights_{"light"}, materials_{"material"};
  Findings findings_;
};

}  // namespace

std::vector<Problem> validate_looks(const v1::Scene& scene) {
  LookCheck looks(scene);
  const std::size_t count =
      check_count(scene.look_size(), limits::max_looks, "look", looks.findings());
  for (std::size_t i = 0; i < count; ++i) looks.check(scene.look(static_cast<int>(i)), i);
  return looks.findings().take();
}

}  // namespace metamer
