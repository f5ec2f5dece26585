#include "common/scene/validate.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "common/scene/findings.h"
#include "common/scene/limits.h"
#include "common/scene/parts.h"

namespace metamer {

namespace {

/// The names of one kind of thing, and which of them had each first.
class Names {
 public:
  explicit Names(std::string kind) : kind_(std::move(kind)) {}

  /// Takes the name of number `index`; an empty one names nothing.
  void take(const std::string& name, std::size_t index, Findings& findings) {
    if (name.empty()) return;
    const std::string field = indexed(kind_, index) + ".name";
    if (name.size() > limits::max_name) {
      findings.add(field, "name is too long (" + std::to_string(name.size()) + " bytes; at most " +
                              std::to_string(limits::max_name) + ")");
    }
    const auto [first, is_new] = first_.try_emplace(name, index);
    if (is_new) {
      names_.push_back(name);
    } else {
      findings.add(field, kind_ + " " + quoted(name) + " is defined twice (first as " +
                              indexed(kind_, first->second) + ")");
    }
  }

  bool contains(const std::string& name) const { return first_.contains(name); }

  /// The end of a sentence about an unknown name. A guess costs a comparison with every name, so
  /// only the first few unknown names get one, and no name that is too long to be shown whole.
  std::string guess(const std::string& name) {
    constexpr std::size_t max_guesses = 10, max_length = 60;
    if (const auto known = guesses_.find(name); known != guesses_.end()) return known->second;
    if (guesses_.size() == max_guesses || name.size() > max_length) return {};
    return guesses_[name] = did_you_mean(name, names_);
  }

 private:
  std::string kind_;
  std::map<std::string, std::size_t> first_;
  std::vector<std::string> names_;
  std::map<std::string, std::string> guesses_;
};

/// The number of parts to check: all of them, or as many as a scene may hold.
std::size_t check_count(int count, std::size_t most, const std::string& kind, Findings& findings) {
  const auto size = static_cast<std::size_t>(count);
  if (size <= most) return size;
  findings.add(indexed(kind, most), "a scene may have at most " + std::to_string(most) + " " +
                                        kind + "s (it has " + std::to_string(size) + ")");
  return most;
}

void check_lights(const v1::Scene& scene, Findings& findings) {
  if (scene.light().empty()) findings.add("light", "the scene needs a light");
  Names names("light");
  const std::size_t count = check_count(scene.light_size(), limits::max_lights, "light", findings);
  for (std::size_t i = 0; i < count; ++i) {
    const v1::Light& light = scene.light(static_cast<int>(i));
    names.take(light.name(), i, findings);
    check_light(light, indexed("light", i), findings);
  }
}

Names check_materials(const v1::Scene& scene, Findings& findings) {
  Names names("material");
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

void check_objects(const v1::Scene& scene, Names& materials, Findings& findings) {
  if (scene.object().empty()) findings.add("object", "the scene needs an object");
  Names names("object");
  const std::size_t count =
      check_count(scene.object_size(), limits::max_objects, "object", findings);
  for (std::size_t i = 0; i < count; ++i) {
    const v1::Object& object = scene.object(static_cast<int>(i));
    const std::string field = indexed("object", i);
    names.take(object.name(), i, findings);
    if (object.material().empty()) {
      findings.add(field, "object needs a material");
    } else if (!materials.contains(object.material())) {
      findings.add(field + ".material", "material " + quoted(object.material()) +
                                            " is not defined" + materials.guess(object.material()));
    }
    check_object(object, field, findings);
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
  Names materials = check_materials(scene, findings);
  check_objects(scene, materials, findings);
  check_settings(scene.settings(), "settings", findings);
  return findings.take();
}

}  // namespace metamer
