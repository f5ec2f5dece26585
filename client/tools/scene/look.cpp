#include "client/tools/scene/look.h"

#include <google/protobuf/util/field_mask_util.h>

#include <utility>

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
    replaced.push_back({"light[" + std::to_string(i) + "].spectrum", change.by});
  }
  if (found) return {};
  return problem("no light named \"" + change.light + "\"" + did_you_mean(change.light, names));
}

/// True for the field itself and for everything inside it.
bool contains(const std::string& outer, const std::string& inner) {
  if (inner.compare(0, outer.size(), outer) != 0) return false;
  return inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[';
}

}  // namespace

Result<std::vector<Replaced>> apply(const Look& look, v1::Scene& scene) {
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
