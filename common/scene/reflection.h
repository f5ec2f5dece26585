#pragma once

#include <google/protobuf/message.h>

#include "common/models/reflection.h"
#include "metamer/v1/material.pb.h"

namespace metamer {

/// The member that is set of a oneof whose members are named by models.def, and its line there.
struct ChosenPart {
  const models::Entry* entry = nullptr;            ///< Null: none is set.
  const google::protobuf::Message* own = nullptr;  ///< Its parameters.
};
ChosenPart chosen_model(const v1::Material& material);
ChosenPart chosen_diffuse_term(const v1::Material& material);
ChosenPart chosen_slope(const v1::Slope& slope);

/// A parameter's value, or its default where the scene leaves it out.
double parameter(const google::protobuf::Message& own, const models::Parameter& parameter);

/// How a material reflects, with every default filled in. The material is sound (check_reflection).
models::Reflection<double> reflection_of(const v1::Material& material);

}  // namespace metamer
