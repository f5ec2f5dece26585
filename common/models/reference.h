#pragma once

#include <Eigen/Core>

#include "common/models/reflection.h"

/// The models in f64 for one point: what plots show and tests trust. The same sources as the
/// renderer's, in another number type.
namespace metamer::models {

Lobes<double> evaluate(const Reflection<double>& reflection, const Angles<double>& angles);

/// The parts by themselves. Shapes, units and limits: shaders/slopes, shaders/attenuations,
/// shaders/diffuse.
double slope(Slope which, const Reflection<double>::Parameters& parameters,
             const Angles<double>& angles);
double attenuation(Attenuation which, double roughness, const Angles<double>& angles);  ///< G/(N·V)
double diffuse(DiffuseTerm which, const Reflection<double>::Parameters& parameters,
               const Angles<double>& angles);

/// Fresnel's equations, shaders/fresnel/fresnel.glsl; u the cosine of the angle of incidence.
double schlick_fresnel(double u, double f);              ///< E[2.2-12]
double dielectric_fresnel(double u, double n);           ///< E[2.2-9]
double conductor_fresnel(double u, double n, double k);  ///< E[2.2-8]
double index_from_reflectance(double f);                 ///< E[2.2-11], f below 1

/// What a lobe whose geometry depends on wavelength is multiplied by, shaders/models/ripples.glsl;
/// 1 where it does not (a negative height). `nm`: the wavelength.
double ripples(double height, double spread, double nm);
/// The weight of F in lobes at a wavelength.
inline double fresnel_weight(const Lobes<double>& lobes, double nm = 550) {
  return lobes.fresnel * ripples(lobes.height, lobes.spread, nm);
}

/// The mirror that is left of a rough surface of Model::he_torrance at the cosine u of incidence.
struct RoughMirror {
  double masking;  ///< S, what of it is seen.
  double depth;    ///< s of exp(−(4πs/λ)²), µm.
};
RoughMirror rough_mirror(const Reflection<double>::Parameters& parameters, double u);

/// The angles of unit vectors, as shaders/surface/angles.glsl has them: normal, tangent (orthogonal
/// to it), to the light, to the viewer.
Angles<double> angles_between(const Eigen::Vector3d& normal, const Eigen::Vector3d& tangent,
                              const Eigen::Vector3d& to_light, const Eigen::Vector3d& to_viewer,
                              double solid_angle = 3.14159265358979323846);

/// A reflection by a line of models.def with its defaults: diffuseness and specularness ½,
/// Beckmann's slopes where the model has facets.
Reflection<double> default_reflection(Model model);

}  // namespace metamer::models
