#pragma once

#include <string>
#include <vector>

#include "common/models/reflection.h"

/// The truth tables in tests/extremes: *.csv, written by truth.py, and vectors/*.csv, by
/// vectors.py.
namespace metamer::extremes {

struct Row {
  std::string kind;                   ///< The file's name: "models", "slopes", …, "fresnel".
  std::string form;                   ///< "cook_torrance", "dielectric_fresnel".
  std::vector<std::string> extremes;  ///< "h=1e-7", "roughness min"; empty: a plain point.
  bool from_vectors;                  ///< It is one of vectors/.
  std::vector<double> inputs;         ///< Eight of Angles, in its order and without versines and
                                      ///< bitangent; N, T, L, V and the solid angle; of Fresnel's
                                      ///< forms u, or f.
  std::vector<double> parameters;
  std::string diffuse, slope, attenuation;  ///< A name and its parameters: "beckmann 0.3".
  std::vector<double> values;               ///< One, or the five of Lobes.
  double peak;                              ///< The largest that the lobe reaches.
  bool single;                              ///< All inputs are exact in f32.
  int line;
};

/// The rows of a file, "models" or "vectors/models"; a failed test and no rows where it can't be
/// read.
const std::vector<Row>& table(const std::string& file);

/// "slopes.csv:12 beckmann (0.5 0.5 1 …; 0.3)".
std::string where(const Row& row);

/// In f64; of vectors made unit again, T orthogonal to N.
models::Angles<double> angles(const Row& row);

/// A name and its numbers, as in the columns diffuse, slope and attenuation.
struct Part {
  std::string name;
  std::vector<double> parameters;
};
Part part(const std::string& text);

/// Which line of models.def has this name; -1: none.
int index_of(models::Kind kind, const std::string& name);

/// What a row of models.csv evaluates.
models::Reflection<double> reflection(const Row& row);

/// The same in f32.
models::Reflection<float> single(const models::Reflection<double>& reflection);

models::Reflection<double>::Parameters parameters(const std::vector<double>& values);
models::Reflection<float>::Parameters single(const models::Reflection<double>::Parameters& values);

}  // namespace metamer::extremes
