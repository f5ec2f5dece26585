#include "client/tools/scene/look_change.h"

#include <google/protobuf/util/field_mask_util.h>
#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <utility>

#include "client/tools/scene/settings_change.h"
#include "common/scene/settings.h"

namespace metamer::client {
namespace {

using google::protobuf::util::FieldMaskUtil;
using google::protobuf::util::MessageDifferencer;

const std::string hand = "by hand";

/// Of the settings those that a look of a scene may say.
bool is_looks(const std::string& path) {
  return path == "observer" || path == "observer_file" || path.rfind("development", 0) == 0;
}

void drop_setting(const std::string& path, Look& look) {
  auto& paths = *look.mask.mutable_paths();
  paths.erase(std::remove(paths.begin(), paths.end(), path), paths.end());
  std::erase_if(look.replaced,
                [&](const Replaced& one) { return one.field == "settings." + path; });
}

/// The paths of the mask that `which` holds of.
template <class Which>
void drop_settings(const Which& which, Look& look) {
  const google::protobuf::FieldMask mask = look.mask;
  for (const std::string& path : mask.paths())
    if (which(path)) drop_setting(path, look);
}

void drop_camera(Look& look) {
  look.camera.reset();
  std::erase_if(look.replaced, [](const Replaced& one) { return one.field == "camera"; });
}

bool is_of_look(const Look& look, const std::string& field) {
  const Replaced* one = find_replaced(look.replaced, field);
  return one != nullptr && !one->from.empty();
}

/// What a look of the scene said: changes that stand in its text.
void drop_chosen(Look& look) {
  std::erase_if(look.lights, [](const LightChange& one) { return !one.from.empty(); });
  std::erase_if(look.materials, [](const MaterialChange& one) { return !one.from.empty(); });
  const Look before = look;
  drop_settings([&](const std::string& path) { return is_of_look(before, "settings." + path); },
                look);
  if (is_of_look(before, "camera")) drop_camera(look);
}

/// The change of that name, at the end where there was none.
template <class Change>
Change& change_of(const std::string& name, google::protobuf::RepeatedPtrField<Change>& changes) {
  for (Change& one : changes)
    if (one.name() == name) return one;
  Change& added = *changes.Add();
  added.set_name(name);
  return added;
}

/// A look of a scene changes a name once, and all lights before those by name: what was said of one
/// before all were changed alike is void.
void add_change(const v1::LookLight& to,
                google::protobuf::RepeatedPtrField<v1::LookLight>& lights) {
  if (to.name() == "*")
    for (v1::LookLight& older : lights) {
      if (to.has_spectrum()) older.clear_spectrum();
      if (to.has_luminance()) older.clear_luminance();
    }
  v1::LookLight& light = change_of(to.name(), lights);
  if (to.has_spectrum()) *light.mutable_spectrum() = to.spectrum();
  if (to.has_luminance()) light.set_luminance(to.luminance());
}

void add_change(const v1::LookMaterial& to,
                google::protobuf::RepeatedPtrField<v1::LookMaterial>& materials) {
  v1::LookMaterial& material = change_of(to.name(), materials);
  if (to.has_diffuse()) *material.mutable_diffuse() = to.diffuse();
  if (to.has_specular()) *material.mutable_specular() = to.specular();
}

bool changes_nothing(const v1::LookLight& light) {
  return !light.has_spectrum() && !light.has_luminance();
}

}  // namespace

Result<Look> choose_look(const Look& now, const v1::Scene& scene, const std::string& name) {
  Result<Look> chosen = look_named(scene, name);
  if (!chosen) return chosen;
  Look look = now;
  drop_chosen(look);
  if (!chosen->lights.empty()) look.lights = std::move(chosen->lights);
  for (MaterialChange& change : chosen->materials) {
    std::erase_if(look.materials, [&](const MaterialChange& one) {
      return one.material.name() == change.material.name();
    });
    look.materials.push_back(std::move(change));
  }
  for (const std::string& path : chosen->mask.paths()) drop_setting(path, look);
  if (chosen->camera) {
    drop_camera(look);
    look.camera = std::move(chosen->camera);
  }
  FieldMaskUtil::MergeOptions options;
  FieldMaskUtil::MergeMessageTo(chosen->settings, chosen->mask, options, &look.settings);
  look.mask.MergeFrom(chosen->mask);
  std::move(chosen->replaced.begin(), chosen->replaced.end(), std::back_inserter(look.replaced));
  return look;
}

Look without_look(const Look& now) {
  Look look = now;
  look.lights.clear();
  look.materials.clear();
  drop_settings(is_looks, look);
  drop_camera(look);
  return look;
}

void set_light(const v1::LookLight& to, Look& look) {
  for (LightChange& older : look.lights) {
    if (to.name() != "*" && to.name() != older.light.name()) continue;
    if (to.has_spectrum()) older.light.clear_spectrum();
    if (to.has_luminance()) older.light.clear_luminance();
  }
  std::erase_if(look.lights, [](const LightChange& one) {
    return !one.light.has_spectrum() && !one.light.has_luminance();
  });
  look.lights.push_back({.light = to, .by = hand});
}

void set_material(const v1::LookMaterial& to, Look& look) {
  for (MaterialChange& older : look.materials) {
    if (to.name() != older.material.name()) continue;
    if (to.has_diffuse()) older.material.clear_diffuse();
    if (to.has_specular()) older.material.clear_specular();
  }
  std::erase_if(look.materials, [](const MaterialChange& one) {
    return !one.material.has_diffuse() && !one.material.has_specular();
  });
  look.materials.push_back({.material = to, .by = hand});
}

void set_setting(const std::string& path, const v1::Settings& settings, Look& look) {
  drop_setting(path, look);
  google::protobuf::FieldMask mask;
  mask.add_paths(path);
  FieldMaskUtil::MergeOptions options;
  options.set_replace_message_fields(true);
  options.set_replace_repeated_fields(true);
  FieldMaskUtil::MergeMessageTo(settings, mask, options, &look.settings);
  look.set(path, hand);
}

void set_observer(v1::Observer observer, Look& look) {
  v1::Settings settings;
  settings.set_observer(observer);
  set_setting("observer", settings, look);
  set_setting("observer_file", settings, look);
}

void set_method(const v1::Settings& own, const v1::Settings& wanted, Look& look) {
  v1::Settings to = own;
  take_older_goal(to);
  to.clear_method();
  to.clear_goal();
  if (wanted.has_goal())
    *to.mutable_goal() = wanted.goal();
  else
    *to.mutable_method() = wanted.method();
  Look only;
  set_settings(own, to, hand, only);

  drop_settings(
      [](const std::string& path) {
        return path.rfind("method", 0) == 0 || path.rfind("goal", 0) == 0;
      },
      look);
  look.settings.clear_method();
  look.settings.clear_goal();
  if (to.has_method()) *look.settings.mutable_method() = to.method();
  if (to.has_goal()) *look.settings.mutable_goal() = to.goal();
  look.mask.MergeFrom(only.mask);
  std::move(only.replaced.begin(), only.replaced.end(), std::back_inserter(look.replaced));
}

v1::Look to_message(const Look& look, const std::string& name) {
  v1::Look message;
  message.set_name(name);
  message.add_light()->set_name("*");
  for (const LightChange& one : look.lights) add_change(one.light, *message.mutable_light());
  for (const MaterialChange& one : look.materials)
    add_change(one.material, *message.mutable_material());
  auto& lights = *message.mutable_light();
  lights.erase(std::remove_if(lights.begin(), lights.end(), changes_nothing), lights.end());
  v1::Settings said;
  FieldMaskUtil::MergeOptions options;
  FieldMaskUtil::MergeMessageTo(look.settings, look.mask, options, &said);
  const auto& paths = look.mask.paths();
  if (!said.observer_file().empty())
    message.set_observer_file(said.observer_file());
  else if (std::find(paths.begin(), paths.end(), "observer") != paths.end())
    message.set_observer(said.observer());
  if (said.has_development()) *message.mutable_development() = said.development();
  if (look.camera) *message.mutable_camera() = *look.camera;
  return message;
}

v1::Scene without_objects(const v1::Scene& scene) {
  v1::Scene rest;
  *rest.mutable_camera() = scene.camera();
  *rest.mutable_light() = scene.light();
  *rest.mutable_material() = scene.material();
  *rest.mutable_settings() = scene.settings();
  *rest.mutable_look() = scene.look();
  return rest;
}

bool look_alike(const Look& one, const Look& other, const v1::Scene& scene) {
  v1::Scene a = scene, b = scene;
  return apply(one, a) && apply(other, b) && MessageDifferencer::Equals(a, b);
}

void add_standard_looks(v1::Scene& scene) {
  for (const char* name : {"D65", "A", "F11"}) {
    v1::Look& look = *scene.add_look();
    look.set_name(name);
    v1::LookLight& light = *look.add_light();
    light.set_name("*");
    light.mutable_spectrum()->set_standard(name);
  }
}

}  // namespace metamer::client
