#pragma once

#include <cstddef>
#include <span>
#include <string_view>

/// The illumination models and the parts that they are put together from, as data: the table
/// models.def. Nothing here or in its users names a model.
namespace metamer::models {

/// What a line of models.def declares.
enum class Kind : unsigned char { model, diffuse, slope, attenuation };

#define METAMER_MODEL(number, name, ...) name,
enum class Model : unsigned char {
#include "common/models/models.def"
};
#define METAMER_DIFFUSE(number, name, ...) name,
enum class DiffuseTerm : unsigned char {
  lambert,  ///< N·L: the term of a material that names none.
#include "common/models/models.def"
};
#define METAMER_SLOPE(number, name, ...) name,
enum class Slope : unsigned char {
#include "common/models/models.def"
};
#define METAMER_ATTENUATION(number, name, ...) name,
enum class Attenuation : unsigned char {
#include "common/models/models.def"
};

/// What is known of a line besides its equation: what it uses, and which laws it keeps.
enum Trait : unsigned {
  weighted = 1,              ///< Uses the material's diffuseness.
  has_fresnel = 2,           ///< Its highlight has a Fresnel term.
  has_facets = 4,            ///< Its highlight has slopes and an attenuation.
  has_ambient = 8,           ///< Reflects light where none of the scene's lights reaches.
  anisotropic = 16,          ///< Needs the tangent.
  reciprocal = 32,           ///< ρ/(N·L) is the same with L and V exchanged.
  symmetric_highlight = 64,  ///< The highlight by itself is, N·L left aside.
  /// Reflects no more than it gets, for d + s ≤ 1; of a slope: ∫2hD dh = 1, E[2.2-14].
  conserving = 128,
  highlighted =
      256,  ///< Uses the material's specularness and, or its Fresnel term in place of it, C_S.
  diffracting = 512,  ///< Its highlight's geometry depends on wavelength (Lobes::height).
};

struct Parameter {
  const char* name;
  double default_value, min, max;  ///< The range is inclusive.
  const char* unit;                ///< "" for a plain number.
  const char* meaning;
};

struct Entry {
  Kind kind;
  int number;           ///< Its field in v1::Material or v1::Slope, or its enum value.
  unsigned char index;  ///< The value of Model, DiffuseTerm, Slope or Attenuation.
  const char* name;     ///< As in the scene: "blinn_phong".
  const char* type;     ///< As in the shaders: "BlinnPhong".
  const char* citation;
  const char* equation;
  unsigned traits;  ///< Of Trait.
  std::span<const Parameter> parameters;
};

/// The entries of a kind, in the order of models.def.
std::span<const Entry> registry(Kind kind);

/// "model", "diffuse term", "slope distribution", "geometric attenuation".
const char* kind_name(Kind kind);

const Entry& entry(Model model);
const Entry& entry(Slope slope);

}  // namespace metamer::models
