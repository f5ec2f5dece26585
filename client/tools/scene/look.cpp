#include "client/tools/scene/look.h"

#include <google/protobuf/util/field_mask_util.h>

#include <algorithm>
#include <utility>

#include "common/scene/settings.h"

namespace metamer::client {
namespace {

using google::protobuf::util::FieldMaskUtil;

Result<void> apply(const LightChange& change, v1::Scene& scene, std::vector<Replaced>& replaced) {
  bool found = false;
  std::vector<std::string> names;
  for (int i = 0; i < scene.light_size(); ++i) {
    v1::Light& light = *scene.mutable_light(i);
    names.push_back(light.name());
    if (change.light != "*" && change.light != light.name()) continue;
    found = true;
    *light.mutable_spectrum() = change.spectrum;
    const std::string field = "light[" + std::to_string(i) + "].spectrum";
    replaced.push_back({field, change.by});
    if (!change.file.empty()) replaced.push_back({field + ".file", change.by, change.file});
  }
  if (found) return {};
  return problem("no light named \"" + change.light + "\"" + did_you_mean(change.light, names));
}

/// True for the field itself and for everything inside it.
bool contains(const std::string& outer, const std::string& inner) {
  if (inner.compare(0, outer.size(), outer) != 0) return false;
  return inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[';
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
  FieldMaskUtil::MergeOptions options;
  options.set_replace_repeated_fields(true);
  FieldMaskUtil::MergeMessageTo(look.settings, look.mask, options, scene.mutable_settings());

  std::vector<Replaced> replaced = look.replaced;
  for (const LightChange& change : look.lights)
    if (const Result<void> done = apply(change, scene, replaced); !done)
      return tl::unexpected(done.error());
  return replaced;
}

std::string replaced_by(const std::vector<Replaced>& replaced, const std::string& field) {
  for (const Replaced& one : replaced)
    if (contains(one.field, field)) return one.by;
  return {};
}

}  // namespace metamer::client
