#include "common/lights/registry.h"

#include <algorithm>

namespace metamer::lights {
namespace {

using Kind = Parameter::Kind;

#define METAMER_POSITION(name, meaning) Parameter{Kind::position, #name, 0, 0, 0, "m", meaning},
#define METAMER_DIRECTION(name, meaning) Parameter{Kind::direction, #name, 0, 0, 0, "", meaning},
#define METAMER_VECTOR(name, meaning) Parameter{Kind::vector, #name, 0, 0, 0, "m", meaning},
#define METAMER_LENGTH(name, otherwise, meaning) \
  Parameter{Kind::length, #name, otherwise, 0, 0, "m", meaning},
#define METAMER_ANGLE(name, otherwise, min, max, meaning) \
  Parameter{Kind::angle, #name, otherwise, min, max, "°", meaning},
#define METAMER_PARAMETER(name, ...) Parameter{Kind::number, #name, __VA_ARGS__},
#define METAMER_LIGHT(number, name, Type, citation, equation, ...) \
  constexpr auto name##_parameters = std::to_array<Parameter>({__VA_ARGS__});
#define METAMER_AREA_LIGHT METAMER_LIGHT
#include "common/lights/lights.def"

#define METAMER_ENTRY(number, name, Type, citation, equation, has_area, ...) \
  Entry{number,   static_cast<unsigned char>(Light::name),                   \
        #name,    #Type,                                                     \
        citation, equation,                                                  \
        has_area, name##_parameters},
#define METAMER_LIGHT(number, name, Type, citation, equation, ...) \
  METAMER_ENTRY(number, name, Type, citation, equation, false)
#define METAMER_AREA_LIGHT(number, name, Type, citation, equation, ...) \
  METAMER_ENTRY(number, name, Type, citation, equation, true)
constexpr std::array entries = {
#include "common/lights/lights.def"
};

constexpr bool fits(const Entry& entry) {
  std::size_t count = 1;
  for (const Parameter& parameter : entry.parameters) count += value_count(parameter.kind);
  return count <= max_values;
}
static_assert(std::all_of(entries.begin(), entries.end(), fits), "raise max_values");

}  // namespace

std::span<const Entry> registry() { return entries; }

const Entry& entry(Light light) { return entries[static_cast<std::size_t>(light)]; }

bool is_local(const Entry& entry) {
  return std::any_of(entry.parameters.begin(), entry.parameters.end(),
                     [](const Parameter& one) { return one.kind == Kind::position; });
}

}  // namespace metamer::lights
