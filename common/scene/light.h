#pragma once

#include <google/protobuf/message.h>

#include "common/lights/registry.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

/// The member that is set of a light's oneof `where`, and its line in lights.def. An environment
/// has none.
struct ChosenLight {
  const lights::Entry* entry = nullptr;            ///< Null: no line is set.
  const google::protobuf::Message* own = nullptr;  ///< Its parameters, or the vector that is all.

  bool is_vector() const { return own->GetDescriptor() == v1::Vec3::descriptor(); }
  /// A position or direction; 0 where the scene leaves it out.
  const v1::Vec3& vector(const lights::Parameter& parameter) const;
  /// An angle in degrees, or a number; its default where the scene leaves it out.
  double number(const lights::Parameter& parameter) const;
};
ChosenLight chosen_light(const v1::Light& light);

}  // namespace metamer
