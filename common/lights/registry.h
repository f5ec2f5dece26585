#pragma once

#include <array>
#include <cstddef>
#include <span>

/// The lights as data: the table lights.def. Nothing here or in its users names a light.
namespace metamer::lights {

#define METAMER_LIGHT(number, name, ...) name,
enum class Light : unsigned char {
#include "common/lights/lights.def"
};

struct Parameter {
  enum class Kind : unsigned char {
    position,   ///< A point; metres.
    direction,  ///< Of any length but 0 in the scene, unit inside.
    angle,      ///< Degrees in the scene, 1 − its cosine inside.
    number,
  };
  Kind kind;
  const char* name;
  double default_value, min, max;  ///< Of an angle or number; the range is inclusive.
  const char* unit;                ///< "" for a plain number.
  const char* meaning;
};

struct Entry {
  int number;           ///< Its field in v1::Light.
  unsigned char index;  ///< The value of Light.
  const char* name;     ///< "spot".
  const char* type;     ///< As in the shaders: "Spot".
  const char* citation;
  const char* equation;
  std::span<const Parameter> parameters;
};

/// The entries in the order of lights.def.
std::span<const Entry> registry();
const Entry& entry(Light light);

/// It has a position, and so distances: a reference distance means something.
bool is_local(const Entry& entry);

/// What a light's struct in the shaders holds, flat: its squared reference distance (0: its
/// luminance holds at every distance), then its parameters, a vector as x y z.
inline constexpr std::size_t max_values = 16;
template <class Real>
using Values = std::array<Real, max_values>;

/// The numbers that a parameter takes there.
constexpr std::size_t value_count(Parameter::Kind kind) {
  return kind == Parameter::Kind::position || kind == Parameter::Kind::direction ? 3 : 1;
}

}  // namespace metamer::lights
