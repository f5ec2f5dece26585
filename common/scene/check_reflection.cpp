#include <algorithm>
#include <cmath>

#include "common/scene/parts.h"
#include "common/scene/reflection.h"
#include "common/scene/schema.h"

namespace metamer {

namespace {

using models::Entry;

void check_parameters(const ChosenPart& part, const std::string& field, Findings& findings) {
  for (const models::Parameter& one : part.entry->parameters) {
    const double value = parameter(*part.own, one);
    if (value >= one.min && value <= one.max) continue;
    const double nearest = std::clamp<double>(value, one.min, one.max);
    findings.add(field + "." + part.entry->name + "." + one.name,
                 std::string(one.name) + " must lie in " + number_text(one.min) + ".." +
                     number_text(one.max) + " (it is " + number_text(value) +
                     "); the nearest allowed value is " + number_text(nearest),
                 value, nearest);
  }
}

/// "strauss has no use for slope; models that have: cook_torrance, blinn".
void check_use(const Entry& model, models::Trait trait, const std::string& name,
               const std::string& field, Findings& findings) {
  if (model.traits & trait) return;
  std::vector<std::string> others;
  for (const Entry& entry : models::registry(models::Kind::model)) {
    if (entry.traits & trait) others.emplace_back(entry.name);
  }
  const bool mirrors = name == "fresnel" || name == "specular";
  findings.add(field + "." + name, std::string(model.name) + " has no use for " + name +
                                       (mirrors ? " without a mirror" : "") +
                                       "; models that have: " + join(others));
}

void check_slopes(const v1::Material& material, const std::string& field, Findings& findings) {
  const std::size_t before = findings.size();
  double sum = 0;
  for (int i = 0; i < material.slope_size(); ++i) {
    const std::string path = indexed(field + ".slope", static_cast<std::size_t>(i));
    if (static_cast<std::size_t>(i) == models::max_slopes) {
      findings.add(path, "a material may have at most " + std::to_string(models::max_slopes) +
                             " slopes (it has " + std::to_string(material.slope_size()) + ")");
      return;
    }
    const v1::Slope& slope = material.slope(i);
    const double weight = slope.has_weight() ? slope.weight() : 1;
    check_range(weight, 0, 1, path + ".weight", findings);
    sum += weight;
    const ChosenPart part = chosen_slope(slope);
    if (part.entry == nullptr) {
      std::vector<std::string> names;
      for (const Entry& entry : models::registry(models::Kind::slope))
        names.emplace_back(entry.name);
      findings.add(path, "slope needs a distribution: " + join(names));
    } else {
      check_parameters(part, path, findings);
    }
  }
  if (findings.size() == before && std::abs(sum - 1) > 1e-6) {
    findings.add(field + ".slope",
                 "the weights of the slopes must sum to 1 (they sum to " + number_text(sum) + ")");
  }
}

}  // namespace

void check_reflection(const v1::Material& material, const std::string& field, Findings& findings) {
  const ChosenPart model = chosen_model(material);
  if (model.entry != nullptr) check_parameters(model, field, findings);
  if (const ChosenPart term = chosen_diffuse_term(material); term.entry != nullptr) {
    check_parameters(term, field, findings);
  }
  if (!material.slope().empty()) check_slopes(material, field, findings);

  // What the model does not look at is said, not left out in silence.
  const Entry& used = model.entry != nullptr ? *model.entry : models::entry(models::Model::lambert);
  const auto use = [&](bool given, models::Trait trait, const char* name) {
    if (given) check_use(used, trait, name, field, findings);
  };
  use(!material.slope().empty(), models::has_facets, "slope");
  use(material.has_attenuation(), models::has_facets, "attenuation");
  // A mirror and a clear surface have a Fresnel term, whatever the model.
  use(material.has_fresnel() && material.mirror() == 0 && !material.has_transmission(),
      models::has_fresnel, "fresnel");
  use(material.has_diffuseness(), models::weighted, "diffuseness");
  use(material.has_specularness(), models::highlighted, "specularness");
  // The mirror has a colour, whatever the model.
  use(material.has_specular() && material.mirror() == 0, models::highlighted, "specular");
  const v1::Fresnel& fresnel = material.fresnel();
  if (material.has_specular() && (fresnel.has_dielectric() || fresnel.has_conductor())) {
    findings.add(field + ".specular",
                 "specular has no effect: the exact Fresnel term takes its place");
  }
}

}  // namespace metamer
