#include "common/scene/reflection.h"

#include <google/protobuf/descriptor.h>

#include <cmath>
#include <string_view>

namespace metamer {

namespace {

using models::Entry;
using models::Kind;

/// Schema and table agree by construction: both are made from models.def.
ChosenPart chosen(const google::protobuf::Message& message, const char* oneof, Kind kind) {
  const auto& get = *message.GetReflection();
  const auto* field =
      get.GetOneofFieldDescriptor(message, message.GetDescriptor()->FindOneofByName(oneof));
  if (field == nullptr) return {};
  for (const Entry& entry : models::registry(kind)) {
    if (entry.number == field->number()) return {&entry, &get.GetMessage(message, field)};
  }
  return {};
}

void fill(const ChosenPart& part, double* to) {
  for (const models::Parameter& one : part.entry->parameters) *to++ = parameter(*part.own, one);
}

/// The mean square of a slope's parameters that are roughnesses: along and across, or one.
double square_roughness(const ChosenPart& part) {
  double sum = 0;
  int count = 0;
  for (const models::Parameter& one : part.entry->parameters) {
    if (!std::string_view(one.name).starts_with("roughness")) continue;
    const double value = parameter(*part.own, one);
    sum += value * value;
    ++count;
  }
  return count == 0 ? 0 : sum / count;
}

void add_slopes(const v1::Material& material, models::Reflection<double>& to) {
  v1::Slope beckmann;
  beckmann.mutable_beckmann();
  double square = 0;
  const auto add = [&](const v1::Slope& slope) {
    const ChosenPart part = chosen_slope(slope);
    auto& one = to.slopes[to.slope_count++];
    one.slope = static_cast<models::Slope>(part.entry->index);
    one.weight = slope.has_weight() ? slope.weight() : 1;
    fill(part, one.parameters.data());
    square += one.weight * square_roughness(part);
  };
  if (material.slope().empty()) add(beckmann);
  for (const v1::Slope& slope : material.slope()) add(slope);
  to.roughness = std::sqrt(square);
}

}  // namespace

ChosenPart chosen_model(const v1::Material& material) {
  return chosen(material, "model", Kind::model);
}

ChosenPart chosen_diffuse_term(const v1::Material& material) {
  return chosen(material, "diffuse_term", Kind::diffuse);
}

ChosenPart chosen_slope(const v1::Slope& slope) { return chosen(slope, "slope", Kind::slope); }

double parameter(const google::protobuf::Message& own, const models::Parameter& parameter) {
  const auto* field = own.GetDescriptor()->FindFieldByName(parameter.name);
  const auto& get = *own.GetReflection();
  return get.HasField(own, field) ? get.GetDouble(own, field) : parameter.default_value;
}

models::Reflection<double> reflection_of(const v1::Material& material) {
  models::Reflection<double> to;
  to.parameters[0] = material.has_diffuseness() ? material.diffuseness() : 1;
  to.parameters[1] = material.specularness();
  if (const ChosenPart model = chosen_model(material); model.entry != nullptr) {
    to.model = static_cast<models::Model>(model.entry->index);
    fill(model, to.parameters.data() + 2);
    if (model.entry->traits & models::has_facets) add_slopes(material, to);
  }
  if (const ChosenPart term = chosen_diffuse_term(material); term.entry != nullptr) {
    to.diffuse = static_cast<models::DiffuseTerm>(term.entry->index);
    fill(term, to.diffuse_parameters.data());
  }
  for (const Entry& entry : models::registry(Kind::attenuation)) {
    if (entry.number == material.attenuation())
      to.attenuation = static_cast<models::Attenuation>(entry.index);
  }
  return to;
}

}  // namespace metamer
