#pragma once

#include <array>
#include <cstddef>
#include <span>

/// The lights as data: the table lights.def. Nothing here or in its users names a light.
namespace metamer::lights {

#define METAMER_LIGHT(number, name, ...) name,
#define METAMER_AREA_LIGHT METAMER_LIGHT
enum class Light : unsigned char {
#include "common/lights/lights.def"
};

struct Parameter {
  enum class Kind : unsigned char {
    position,   ///< A point; metres.
    direction,  ///< Of any length but 0 in the scene, unit inside.
    vector,     ///< A direction whose length counts; metres, not 0.
    length,     ///< Metres, above 0.
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
  bool has_area;  ///< It is a surface that shines, not a place or a direction.
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
  using enum Parameter::Kind;
  return kind == position || kind == direction || kind == vector ? 3 : 1;
}

}  // namespace metamer::lights
