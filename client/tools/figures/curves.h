#pragma once

#include <map>
#include <string>
#include <vector>

#include "client/tools/figures/catalogue.h"
#include "client/tools/figures/figure.h"

/// The diagrams of one line of the catalogue. All values are those of the f64 reference.
namespace metamer::client {

/// Values of parameters by name, in place of what a diagram would choose by itself.
using Values = std::map<std::string, double>;

/// What of a diagram can be set: a model's own parameters; with it diffuseness and specularness,
/// the roughness of its slopes (Beckmann's), f of its Fresnel term (Schlick's; 1: none) where it
/// has these; the light's incidence where a light comes in.
std::vector<models::Parameter> plot_parameters(const CatalogueItem& item);

/// Values as written, "shininess=120", against the parameters of what is drawn. Errors: no such
/// form, a parameter that none of the items has, no number, out of range.
Result<Values> parse_values(const std::vector<std::string>& words,
                            const std::vector<CatalogueItem>& items);

/// The diagram of an item. `values` may name parameters that are not the item's.
Figure figure_of(const CatalogueItem& item, const Values& values);

// What diagrams are made of. Angles in degrees; light and viewer in one plane with the normal,
// the light at -incidence, so that it is mirrored to +incidence.

/// ρ over the viewing angle, with C_D = C_S = 1 and F by Schlick from f. A tangent across the plane
/// of incidence shows an anisotropic surface from its other side.
Curve brdf_curve(const std::string& label, const models::Reflection<double>& reflection, double f,
                 double incidence, bool tangent_across = false);
/// What stands for N·L in the diffuse part, alone.
Curve diffuse_curve(const std::string& label, models::DiffuseTerm term,
                    const models::Reflection<double>::Parameters& parameters, double incidence);
/// D over the angle between normal and bisector, also relative to its peak.
Curve slope_curve(const std::string& label, models::Slope slope,
                  const models::Reflection<double>::Parameters& parameters, bool across = false);
Curve relative_to_peak(Curve curve);
/// G over the viewing angle.
Curve attenuation_curve(const std::string& label, models::Attenuation attenuation, double roughness,
                        double incidence);
/// F over the angle of incidence, 0 to 90°.
Curve fresnel_curve(const std::string& label, const models::FresnelForm& form,
                    std::vector<double> parameters);

/// "θ = 30°"
std::string incidence_label(double incidence);
/// "σ = 0.3"
std::string value_label(const char* symbol, double value);

}  // namespace metamer::client
