#include "common/models/registry.h"

#include <array>

namespace metamer::models {
namespace {

/// A list of parameters ends with an entry that is left out of its span: an array can't be empty.
constexpr std::span<const Parameter> without_end(std::span<const Parameter> list) {
  return list.first(list.size() - 1);
}

#define METAMER_PARAMETER(name, ...) Parameter{#name, __VA_ARGS__},
#define METAMER_LIST(kind, name, ...) \
  constexpr std::array kind##_##name = std::to_array<Parameter>({__VA_ARGS__ Parameter{}});
#define METAMER_MODEL(number, name, Type, citation, equation, traits, ...) \
  METAMER_LIST(model, name, __VA_ARGS__)
#define METAMER_DIFFUSE(number, name, Type, citation, equation, traits, ...) \
  METAMER_LIST(diffuse, name, __VA_ARGS__)
#define METAMER_SLOPE(number, name, Type, citation, equation, traits, ...) \
  METAMER_LIST(slope, name, __VA_ARGS__)
#define METAMER_ATTENUATION(number, name, Type, citation, equation, traits, ...) \
  METAMER_LIST(attenuation, name, __VA_ARGS__)
#include "common/models/models.def"
#undef METAMER_LIST

#define METAMER_ENTRY(kind, Enum, number, name, Type, citation, equation, traits) \
  Entry{Kind::kind, number,   static_cast<unsigned char>(Enum::name),             \
        #name,      #Type,    citation,                                           \
        equation,   (traits), without_end(kind##_##name)},
constexpr std::array model_entries = {
#define METAMER_MODEL(number, name, Type, citation, equation, traits, ...) \
  METAMER_ENTRY(model, Model, number, name, Type, citation, equation, traits)
#include "common/models/models.def"
};
constexpr std::array diffuse_entries = {
#define METAMER_DIFFUSE(number, name, Type, citation, equation, traits, ...) \
  METAMER_ENTRY(diffuse, DiffuseTerm, number, name, Type, citation, equation, traits)
#include "common/models/models.def"
};
constexpr std::array slope_entries = {
#define METAMER_SLOPE(number, name, Type, citation, equation, traits, ...) \
  METAMER_ENTRY(slope, Slope, number, name, Type, citation, equation, traits)
#include "common/models/models.def"
};
constexpr std::array attenuation_entries = {
#define METAMER_ATTENUATION(number, name, Type, citation, equation, traits, ...) \
  METAMER_ENTRY(attenuation, Attenuation, number, name, Type, citation, equation, traits)
#include "common/models/models.def"
};
#undef METAMER_ENTRY

}  // namespace

std::span<const Entry> registry(Kind kind) {
  switch (kind) {
    case Kind::model:
      return model_entries;
    case Kind::diffuse:
      return diffuse_entries;
    case Kind::slope:
      return slope_entries;
    case Kind::attenuation:
      return attenuation_entries;
  }
  return {};
}

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::model:
      return "model";
    case Kind::diffuse:
      return "diffuse term";
    case Kind::slope:
      return "slope distribution";
    case Kind::attenuation:
      return "geometric attenuation";
  }
  return "";
}

const Entry& entry(Model model) { return model_entries[static_cast<std::size_t>(model)]; }
const Entry& entry(Slope slope) { return slope_entries[static_cast<std::size_t>(slope)]; }

}  // namespace metamer::models
