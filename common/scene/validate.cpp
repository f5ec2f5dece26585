#include "common/scene/validate.h"

#include <algorithm>
#include <map>
#include <optional>

#include "common/scene/findings.h"
#include "common/scene/limits.h"
#include "common/scene/part_names.h"
#include "common/scene/parts.h"

namespace metamer {

namespace {

void check_lights(const v1::Scene& scene, Findings& findings) {
  if (scene.light().empty()) findings.add("light", "the scene needs a light");
  PartNames names("light");
  std::optional<std::size_t> environment;
  const std::size_t count = check_count(scene.light_size(), limits::max_lights, "light", findings);
  for (std::size_t i = 0; i < count; ++i) {
    const v1::Light& light = scene.light(static_cast<int>(i));
    names.take(light.name(), i, findings);
    check_light(light, indexed("light", i), findings);
    if (!light.has_environment()) continue;
    if (environment)
      findings.add(indexed("light", i), "a scene has one environment (the first is " +
                                            indexed("light", *environment) + ")");
    else
      environment = i;
  }
}

PartNames check_materials(const v1::Scene& scene, Findings& findings) {
  PartNames names("material");
  const std::size_t count =
      check_count(scene.material_size(), limits::max_materials, "material", findings);
  for (std::size_t i = 0; i < count; ++i) {
    const v1::Material& material = scene.material(static_cast<int>(i));
    if (material.name().empty()) findings.add(indexed("material", i), "material needs a name");
    names.take(material.name(), i, findings);
    check_material(material, indexed("material", i), findings);
  }
  // Those over the limit are known all the same: an object that uses one is not wrong, too.
  for (int i = static_cast<int>(count); i < scene.material_size(); ++i) {
    names.take(scene.material(i).name(), static_cast<std::size_t>(i), findings);
  }
  return names;
}

PartNames check_objects(const v1::Scene& scene, PartNames& materials, Findings& findings) {
  if (scene.object().empty()) findings.add("object", "the scene needs an object");
  PartNames names("object");
  const std::size_t count =
      check_count(scene.object_size(), limits::max_objects, "object", findings);
  for (std::size_t i = 0; i < count; ++i) {
    const v1::Object& object = scene.object(static_cast<int>(i));
    const std::string field = indexed("object", i);
    names.take(object.name(), i, findings);
    if (object.material().empty()) {
      findings.add(field, "object needs a material");
    } else {
      materials.check_known(object.material(), field + ".material", findings);
    }
    check_object(object, field, findings);
  }
  return names;
}

/// The item of this name; null: there is none.
template <class Item>
const Item* named(const google::protobuf::RepeatedPtrField<Item>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&](const Item& item) { return item.name() == name; });
  return found != items.end() ? &*found : nullptr;
}

/// The objects that shine.
void check_shining(const v1::Scene& scene, PartNames& objects, Findings& findings) {
  std::map<std::string, int> lights;
  for (int i = 0; i < scene.light_size(); ++i) {
    if (!scene.light(i).has_object()) continue;
    const std::string field = indexed("light", static_cast<std::size_t>(i)) + ".object";
    const std::string& name = scene.light(i).object();
    if (name.empty()) {
      findings.add(field, "light needs the name of an object");
      continue;
    }
    objects.check_known(name, field, findings);
    const v1::Object* object = named(scene.object(), name);
    if (object == nullptr) continue;
    const v1::Material* material = named(scene.material(), object->material());
    const auto [first, is_new] = lights.try_emplace(name, i);
    if (object->has_plane())
      findings.add(field, "a plane has no end: it can't shine");
    else if (material != nullptr && material->has_transmission())
      findings.add(field, "its material is clear: what lets light through can't shine");
    else if (material != nullptr && material->has_alpha())
      findings.add(field, "its material has alpha: what is not all there can't shine");
    else if (!is_new)
      findings.add(field, "it shines already, by " +
                              indexed("light", static_cast<std::size_t>(first->second)));
  }
}

}  // namespace

std::vector<Problem> validate_scene(const v1::Scene& scene) {
  Findings findings;
  check_fields_known(scene, "scene", findings);
  if (scene.has_camera()) {
    check_camera(scene.camera(), "camera", findings);
  } else {
    findings.add("camera", "the scene needs a camera");
  }
  check_lights(scene, findings);
  PartNames materials = check_materials(scene, findings);
  PartNames objects = check_objects(scene, materials, findings);
  check_shining(scene, objects, findings);
  check_settings(scene.settings(), "settings", findings);
  return findings.take();
}

}  // namespace metamer
