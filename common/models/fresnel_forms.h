#pragma once

#include <array>
#include <span>

#include "common/models/reference.h"

/// The forms of the Fresnel term, as data like models.def's. They have no line there, because a
/// scene gives them spectra where the others have numbers.
namespace metamer::models {

struct FresnelForm {
  const char* name;  ///< As in v1::Fresnel.
  const char* citation;
  const char* equation;
  std::span<const Parameter> parameters;                ///< At one wavelength.
  double (*value)(double u, const double* parameters);  ///< In f64; u the cosine of incidence.
};

inline constexpr Parameter schlick_fresnel_parameters[] = {
    {"f", 0.04, 0, 1, "", "reflectance at normal incidence: the material's C_S"}};
inline constexpr Parameter dielectric_parameters[] = {
    {"n", 1.5, 0.01, 100, "", "index of refraction"}};
inline constexpr Parameter conductor_parameters[] = {
    {"n", 0.2, 0.01, 100, "", "index of refraction"},
    {"k", 3.9, 0, 100, "", "extinction coefficient"}};

inline constexpr std::array fresnel_forms = {
    FresnelForm{"schlick",
                "C. Schlick, An inexpensive BRDF model for physically-based rendering (1994); "
                "E[2.2-12]",
                "f + (1 − f)(1 − u)⁵", schlick_fresnel_parameters,
                [](double u, const double* p) { return schlick_fresnel(u, p[0]); }},
    FresnelForm{"dielectric",
                "A. Fresnel (1823), as in R. L. Cook and K. E. Torrance, A reflectance model for "
                "computer graphics (1981); E[2.2-9]",
                "½ (a − u)²/(a + u)² ((u(a + u) − 1)²/(u(a − u) + 1)² + 1), a = √(n² + u² − 1)",
                dielectric_parameters,
                [](double u, const double* p) { return dielectric_fresnel(u, p[0]); }},
    FresnelForm{"conductor",
                "A. Fresnel (1823), with a complex index as in C. Schlick, An inexpensive BRDF "
                "model for physically-based rendering (1994); E[2.2-8]",
                "½ ((a − u)² + b²)/((a + u)² + b²) (((a + u − 1/u)² + b²)/((a − u + 1/u)² + b²) + "
                "1), a² = ½(√(t² + 4n²k²) + t), b² = ½(√(t² + 4n²k²) − t), t = n² − k² + u² − 1",
                conductor_parameters,
                [](double u, const double* p) { return conductor_fresnel(u, p[0], p[1]); }},
};

}  // namespace metamer::models
