#include "client/tools/scene/look.h"

#include <google/protobuf/util/field_mask_util.h>

#include <algorithm>
#include <utility>

#include "common/scene/settings.h"

namespace metamer::client {
namespace {

using google::protobuf::util::FieldMaskUtil;

/// "look[1].light[0].spectrum"; nothing where the change is not in the text.
std::string place_of(const std::string& from, const char* member) {
  return from.empty() ? from : from + "." + member;
}

tl::unexpected<Problem> unknown_name(const char* kind, const std::string& name,
                                     const std::vector<std::string>& names,
                                     const std::string& from) {
  Problem wrong =
      metamer::unknown_name("no " + std::string(kind) + " named " + quoted(name), name, names);
  wrong.field = place_of(from, "name");
  return tl::unexpected(std::move(wrong));
}

/// Its spectra are not one that can be put in another's place.
bool is_sky(const v1::Light& light) { return light.environment().has_sky(); }

Result<void> apply(const LightChange& change, v1::Scene& scene, std::vector<Replaced>& replaced) {
  const v1::LookLight& to = change.light;
  // A spectrum for all lights is for those that can have one, where there are any.
  const bool passes_skies = to.name() == "*" && to.has_spectrum() &&
                            !std::all_of(scene.light().begin(), scene.light().end(), is_sky);
  bool found = false;
  std::vector<std::string> names;
  for (int i = 0; i < scene.light_size(); ++i) {
    v1::Light& light = *scene.mutable_light(i);
    names.push_back(light.name());
    if (to.name() != "*" && to.name() != light.name()) continue;
    found = true;
    const std::string field = "light[" + std::to_string(i) + "].";
    if (to.has_spectrum() && !(passes_skies && is_sky(light))) {
      *light.mutable_spectrum() = to.spectrum();
      replaced.push_back({field + "spectrum", change.by, {}, place_of(change.from, "spectrum")});
      if (!change.file.empty())
        replaced.push_back({field + "spectrum.file", change.by, change.file});
    }
    if (to.has_luminance()) {
      light.set_luminance(to.luminance());
      replaced.push_back({field + "luminance", change.by, {}, place_of(change.from, "luminance")});
    }
  }
  if (found) return {};
  return unknown_name("light", to.name(), names, change.from);
}

Result<void> apply(const MaterialChange& change, v1::Scene& scene,
                   std::vector<Replaced>& replaced) {
  const v1::LookMaterial& to = change.material;
  bool found = false;
  std::vector<std::string> names;
  for (int i = 0; i < scene.material_size(); ++i) {
    v1::Material& material = *scene.mutable_material(i);
    names.push_back(material.name());
    if (to.name() != material.name()) continue;
    found = true;
    const std::string field = "material[" + std::to_string(i) + "].";
    if (to.has_diffuse()) {
      *material.mutable_diffuse() = to.diffuse();
      replaced.push_back({field + "diffuse", change.by, {}, place_of(change.from, "diffuse")});
    }
    if (to.has_specular()) {
      *material.mutable_specular() = to.specular();
      replaced.push_back({field + "specular", change.by, {}, place_of(change.from, "specular")});
    }
  }
  if (found) return {};
  return unknown_name("material", to.name(), names, change.from);
}

/// True for the field itself and for everything inside it.
bool contains(const std::string& outer, const std::string& inner) {
  if (inner.compare(0, outer.size(), outer) != 0) return false;
  return inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[';
}

/// Where both have a list, at any depth, that of `into` goes: merging would put one behind the
/// other.
void clear_lists(const google::protobuf::Message& from, google::protobuf::Message& into) {
  const auto& reflection = *from.GetReflection();
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  reflection.ListFields(from, &fields);
  for (const auto* field : fields)
    if (field->is_repeated())
      reflection.ClearField(&into, field);
    else if (field->message_type() != nullptr && reflection.HasField(into, field))
      clear_lists(reflection.GetMessage(from, field), *reflection.MutableMessage(&into, field));
}

/// A method and a goal exclude each other: where the look has one, the scene's other goes.
void make_room(const google::protobuf::FieldMask& mask, v1::Settings& settings) {
  const auto names = [&](const char* field) {
    return std::any_of(mask.paths().begin(), mask.paths().end(),
                       [&](const std::string& path) { return contains(field, path); });
  };
  take_older_goal(settings);
  const bool method = names("method"), goal = names("goal");
  if (method) settings.clear_goal();
  if (goal) settings.clear_method();
}

}  // namespace

Result<std::vector<Replaced>> apply(const Look& look, v1::Scene& scene) {
  make_room(look.mask, *scene.mutable_settings());
  v1::Settings said;
  FieldMaskUtil::MergeMessageTo(look.settings, look.mask, {}, &said);
  clear_lists(said, *scene.mutable_settings());
  FieldMaskUtil::MergeOptions options;
  options.set_replace_repeated_fields(true);
  FieldMaskUtil::MergeMessageTo(look.settings, look.mask, options, scene.mutable_settings());

  std::vector<Replaced> replaced = look.replaced;
  for (const LightChange& change : look.lights)
    if (const Result<void> done = apply(change, scene, replaced); !done)
      return tl::unexpected(done.error());
  for (const MaterialChange& change : look.materials)
    if (const Result<void> done = apply(change, scene, replaced); !done)
      return tl::unexpected(done.error());
  if (look.camera) *scene.mutable_camera() = *look.camera;
  return replaced;
}

const Replaced* find_replaced(const std::vector<Replaced>& replaced, const std::string& field) {
  for (auto one = replaced.rbegin(); one != replaced.rend(); ++one)
    if (contains(one->field, field)) return &*one;
  return nullptr;
}

std::string replaced_by(const std::vector<Replaced>& replaced, const std::string& field) {
  const Replaced* one = find_replaced(replaced, field);
  return one == nullptr ? std::string() : one->by;
}

}  // namespace metamer::client
