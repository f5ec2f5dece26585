#include "server/models/models.h"

namespace metamer::models {
namespace {

#define METAMER_PARAMETER(name, ...) ParameterInfo{#name, __VA_ARGS__},
#define METAMER_MODEL(number, name, Type, citation, ...) \
  constexpr std::array name##_parameters =               \
      std::to_array<ParameterInfo>({__VA_ARGS__ ParameterInfo{}});
#include "server/models/models.def"
#undef METAMER_MODEL
#undef METAMER_PARAMETER

/// The list without the entry that ends it (an array can't be empty).
constexpr std::span<const ParameterInfo> without_end(std::span<const ParameterInfo> list) {
  return list.first(list.size() - 1);
}

constexpr std::array models = {
#define METAMER_MODEL(number, name, Type, citation, ...) \
  ModelInfo{number, Model::name, #name, citation, without_end(name##_parameters)},
#include "server/models/models.def"
#undef METAMER_MODEL
};

}  // namespace

std::span<const ModelInfo> registry() { return models; }

}  // namespace metamer::models
