// The diagram that `metamer models plot NAME` draws, kind by kind.
#include <charconv>
#include <cmath>

#include "client/tools/figures/curves.h"
#include "common/models/reference.h"
#include "common/spectral/optical_constants.h"

namespace metamer::client {
namespace {

using models::Parameter;

constexpr Parameter incidence_parameter = {
    "incidence", 0, 0, 89.5, "degrees", "between the normal and the light"};
constexpr Parameter roughness_parameter = {"roughness", 0.3, 0.001, 1, "", "σ of the slopes"};
constexpr double sodium = 589.3;  ///< nm: the wavelength at which indices are tabulated.

double value_or(const Values& values, const char* name, double otherwise) {
  const auto found = values.find(name);
  return found == values.end() ? otherwise : found->second;
}

/// The value set, or what the diagram shows by itself.
std::vector<double> value_or(const Values& values, const char* name,
                             const std::vector<double>& otherwise) {
  const auto found = values.find(name);
  return found == values.end() ? otherwise : std::vector<double>{found->second};
}

void fill(double* to, std::span<const Parameter> parameters, const Values& values) {
  for (const Parameter& one : parameters) *to++ = value_or(values, one.name, one.default_value);
}

double at_sodium(const Spectrum& spectrum) {
  return resample(spectrum, {sodium}, Outside::hold).values[0];
}

std::string described(const CatalogueItem& item, const Values& values) {
  std::string text = std::string(item.name) + " (" + item.kind + ")";
  for (const Parameter& one : plot_parameters(item))
    if (values.count(one.name))
      text += std::string(", ") + one.name + " " + number_text(values.at(one.name));
  return text;
}

void draw_model(const CatalogueItem& item, const Values& values, Figure& figure) {
  auto reflection = models::default_reflection(static_cast<models::Model>(item.entry->index));
  reflection.parameters[0] = value_or(values, "diffuseness", 0.5);
  reflection.parameters[1] = value_or(values, "specularness", 0.5);
  fill(reflection.parameters.data() + 2, item.parameters, values);
  if (item.traits & models::has_facets) {
    reflection.roughness = value_or(values, "roughness", reflection.roughness);
    reflection.slopes[0].parameters[0] = reflection.roughness;
  }
  const double f = value_or(values, "f", 1);

  const bool anisotropic = (item.traits & models::anisotropic) != 0;
  figure.columns = anisotropic ? 2 : 1;
  for (const bool across : {false, true}) {
    if (across && !anisotropic) continue;
    Panel panel{.title = across        ? "across the tangent"
                         : anisotropic ? "along the tangent"
                                       : "",
                .polar = true,
                .angle = "viewing angle",
                .value = "ρ",
                .curves = {}};
    for (const double incidence : value_or(values, "incidence", std::vector<double>{0, 30, 45, 60}))
      panel.curves.push_back(
          brdf_curve(incidence_label(incidence), reflection, f, incidence, across));
    figure.panels.push_back(panel);
  }
}

void draw_diffuse(const CatalogueItem& item, const Values& values, Figure& figure) {
  const auto term = static_cast<models::DiffuseTerm>(item.entry->index);
  const auto incidences = value_or(values, "incidence", std::vector<double>{40, 70});
  figure.columns = static_cast<int>(incidences.size());
  for (const double incidence : incidences) {
    Panel panel{.title = "light at " + incidence_label(incidence),
                .polar = true,
                .angle = "viewing angle",
                .value = "ρ",
                .curves = {diffuse_curve("Lambert", models::DiffuseTerm::lambert, {}, incidence)}};
    for (const double roughness : value_or(values, "roughness", std::vector<double>{0.3, 0.6, 1}))
      panel.curves.push_back(
          diffuse_curve(value_label("σ", roughness), term, {roughness}, incidence));
    figure.panels.push_back(panel);
  }
}

void draw_slope(const CatalogueItem& item, const Values& values, Figure& figure) {
  const auto slope = static_cast<models::Slope>(item.entry->index);
  models::Reflection<double>::Parameters parameters{};
  fill(parameters.data(), item.parameters, values);
  Panel panel{.title = "", .angle = "angle between N and H", .value = "D", .curves = {}};
  if (item.traits & models::anisotropic) {
    panel.curves = {slope_curve("along the tangent", slope, parameters),
                    slope_curve("across the tangent", slope, parameters, true)};
  } else {
    for (const double roughness : value_or(values, "roughness", std::vector{0.2, 0.3, 0.5})) {
      parameters[0] = roughness;
      panel.curves.push_back(slope_curve(value_label("σ", roughness), slope, parameters));
    }
  }
  Panel relative{.title = "relative to the peak", .polar = true, .value = "D/D(0)", .curves = {}};
  for (const Curve& curve : panel.curves) relative.curves.push_back(relative_to_peak(curve));
  figure.columns = 2;
  figure.panels = {panel, relative};
}

void draw_attenuation(const CatalogueItem& item, const Values& values, Figure& figure) {
  const auto attenuation = static_cast<models::Attenuation>(item.entry->index);
  const auto incidences = value_or(values, "incidence", std::vector<double>{30, 65});
  // One that knows no roughness has one curve.
  const bool rough = attenuation != models::Attenuation::torrance_sparrow;
  figure.columns = static_cast<int>(incidences.size());
  for (const double incidence : incidences) {
    Panel panel{.title = "light at " + incidence_label(incidence),
                .angle = "viewing angle",
                .value = "G",
                .curves = {}};
    for (const double roughness : value_or(values, "roughness", std::vector{0.1, 0.3, 0.5})) {
      panel.curves.push_back(attenuation_curve(rough ? value_label("σ", roughness) : item.name,
                                               attenuation, roughness, incidence));
      if (!rough) break;
    }
    figure.panels.push_back(panel);
  }
}

void draw_fresnel(const CatalogueItem& item, const Values& values, Figure& figure) {
  const models::FresnelForm& form = *item.fresnel;
  Panel panel{.title = "", .angle = "angle of incidence", .value = "F", .curves = {}};
  const std::string form_name = form.name;
  std::vector<double> parameters(form.parameters.size());
  fill(parameters.data(), form.parameters, values);
  bool set = false;
  for (const Parameter& one : form.parameters) set = set || values.count(one.name);

  if (set) {
    std::string label;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      label += (i ? ", " : "") + value_label(form.parameters[i].name, parameters[i]);
    panel.curves.push_back(fresnel_curve(label, form, parameters));
  } else if (form_name == "dielectric") {
    panel.title = "the media that are shipped, at 589.3 nm";
    for (const Medium& medium : media()) {
      const double n = std::sqrt(sellmeier_squared(medium.terms, sodium));
      panel.curves.push_back(fresnel_curve(medium.name, form, {n}));
    }
  } else if (form_name == "conductor") {
    panel.title = "the metals that are shipped, at 589.3 nm";
    for (const Metal& metal : metals())
      panel.curves.push_back(
          fresnel_curve(metal.name, form, {at_sodium(metal.n), at_sodium(metal.k)}));
  } else {
    for (const double f : {0.02, 0.04, 0.17, 0.32, 0.6, 0.9})
      panel.curves.push_back(fresnel_curve(value_label("f", f), form, {f}));
  }
  figure.panels = {panel};
}

}  // namespace

std::vector<Parameter> plot_parameters(const CatalogueItem& item) {
  std::vector<Parameter> parameters(item.parameters.begin(), item.parameters.end());
  if (!item.entry) return parameters;
  const models::Kind kind = item.entry->kind;
  if (item.traits & models::weighted) parameters.push_back({"diffuseness", 0.5, 0, 1, "", "d"});
  if (item.traits & models::highlighted) parameters.push_back({"specularness", 0.5, 0, 1, "", "s"});
  if ((item.traits & models::has_facets) ||
      (kind == models::Kind::attenuation &&
       item.entry->index != static_cast<unsigned char>(models::Attenuation::torrance_sparrow)))
    parameters.push_back(roughness_parameter);
  if (item.traits & models::has_fresnel)
    parameters.push_back({"f", 1, 0, 1, "", "reflectance at normal incidence; 1: no Fresnel term"});
  if (kind != models::Kind::slope) parameters.push_back(incidence_parameter);
  return parameters;
}

Result<Values> parse_values(const std::vector<std::string>& words,
                            const std::vector<CatalogueItem>& items) {
  Values values;
  for (const std::string& word : words) {
    // Take the word apart.
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos)
      return problem(quoted(word) + " is not PARAMETER=VALUE, such as shininess=120");
    const std::string name = word.substr(0, equals), number = word.substr(equals + 1);
    double value = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(value))
      return problem(name + ": " + quoted(number) + " is not a number");

    // Every item that has the parameter must be able to take the value.
    std::vector<std::string> known;
    bool found = false;
    for (const CatalogueItem& item : items)
      for (const Parameter& one : plot_parameters(item)) {
        known.emplace_back(one.name);
        if (name != one.name) continue;
        found = true;
        if (value >= one.min && value <= one.max) continue;
        const double nearest = value < one.min ? one.min : one.max;
        return problem(name + " of " + item.name + " must lie in " + number_text(one.min) + ".." +
                       number_text(one.max) + "; the nearest to " + number_text(value) + " is " +
                       number_text(nearest));
      }
    if (!found)
      return problem("nothing that is drawn has a parameter " + quoted(name) +
                     did_you_mean(name, known));
    values[name] = value;
  }
  return values;
}

Figure figure_of(const CatalogueItem& item, const Values& values) {
  Figure figure{.name = std::string(item.folder) + "-" + item.name,
                .title = described(item, values),
                .citation = std::string(item.symbol) + " = " + item.equation + "\n" + item.citation,
                .columns = 1,
                .panels = {}};
  if (item.fresnel) {
    draw_fresnel(item, values, figure);
    return figure;
  }
  switch (item.entry->kind) {
    case models::Kind::model:
      draw_model(item, values, figure);
      break;
    case models::Kind::diffuse:
      draw_diffuse(item, values, figure);
      break;
    case models::Kind::slope:
      draw_slope(item, values, figure);
      break;
    case models::Kind::attenuation:
      draw_attenuation(item, values, figure);
      break;
  }
  return figure;
}

}  // namespace metamer::client
