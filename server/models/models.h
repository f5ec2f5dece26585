#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "server/cpu/lanes.h"

/// The illumination models: their table, and their evaluation. Made from models.def and
/// shaders/models/*.glsl; nothing here names a model.
namespace metamer::models {

enum class Model : unsigned char {
#define METAMER_MODEL(number, name, Type, citation, ...) name,
#include "server/models/models.def"
#undef METAMER_MODEL
};

struct ParameterInfo {
  const char* name;
  double default_value, min, max;  ///< The range is inclusive.
  const char* unit;                ///< "" for a plain number.
  const char* meaning;
};

struct ModelInfo {
  int number;  ///< Its field in v1::Material.
  Model model;
  const char* name;  ///< As in the scene: "blinn_phong".
  const char* citation;
  std::span<const ParameterInfo> parameters;
};

/// Every model, in the order of models.def; indexed by Model.
std::span<const ModelInfo> registry();

/// The numbers that a model's struct holds: diffuseness, specularness, then its parameters.
inline constexpr std::size_t max_parameters = 16;
using Parameters = std::array<float, max_parameters>;
using Parameters64 = std::array<double, max_parameters>;

/// Angles and lobes of eight points; see shaders/models/lobes.glsl.
struct AngleLanes {
  Float8 n_dot_l, n_dot_h;
};
struct LobeLanes {
  Float8 diffuse, specular, white;
};

/// The model for eight points of one material, in f32 by the shared source.
LobeLanes evaluate(Model model, const Parameters& parameters, const AngleLanes& angles);

/// The same source in f64, for one point: the reference.
struct Angles64 {
  double n_dot_l, n_dot_h;
};
struct Lobes64 {
  double diffuse, specular, white;
};
Lobes64 evaluate(Model model, const Parameters64& parameters, const Angles64& angles);

}  // namespace metamer::models
