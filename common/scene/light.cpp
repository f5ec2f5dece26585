#include "common/scene/light.h"

#include <google/protobuf/descriptor.h>

namespace metamer {

namespace {

const google::protobuf::FieldDescriptor* field_of(const google::protobuf::Message& message,
                                                  const lights::Parameter& parameter) {
  return message.GetDescriptor()->FindFieldByName(parameter.name);
}

}  // namespace

const v1::Vec3& ChosenLight::vector(const lights::Parameter& parameter) const {
  const google::protobuf::Message& found =
      is_vector() ? *own : own->GetReflection()->GetMessage(*own, field_of(*own, parameter));
  return static_cast<const v1::Vec3&>(found);
}

double ChosenLight::number(const lights::Parameter& parameter) const {
  const auto* field = field_of(*own, parameter);
  const auto& get = *own->GetReflection();
  return get.HasField(*own, field) ? get.GetDouble(*own, field) : parameter.default_value;
}

/// Schema and table agree by construction: the one is made from the other.
ChosenLight chosen_light(const v1::Light& light) {
  const auto& get = *light.GetReflection();
  const auto* field =
      get.GetOneofFieldDescriptor(light, v1::Light::descriptor()->FindOneofByName("where"));
  if (field == nullptr) return {};
  for (const lights::Entry& entry : lights::registry())
    if (entry.number == field->number()) return {&entry, &get.GetMessage(light, field)};
  return {};
}

}  // namespace metamer
