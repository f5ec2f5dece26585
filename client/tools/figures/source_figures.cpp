// The diagrams of the source's chapter 2.2. Captions give s, d, exponents and roughnesses; they
// leave open where the light of the polar diagrams comes from. Here it comes from 0°, 30° and 60°.
#include "client/tools/figures/source_figures.h"

#include <cmath>

#include "client/tools/figures/curves.h"
#include "common/models/reference.h"

namespace metamer::client {
namespace {

using models::Model;

const std::vector<double> incidences = {0, 30, 60};
const std::vector<double> roughnesses = {0.2, 0.3, 0.5};

/// s = d = ½ and one parameter of the model's own.
models::Reflection<double> phong_like(Model model, double parameter) {
  auto reflection = models::default_reflection(model);
  reflection.parameters[2] = parameter;
  return reflection;
}

Panel polar(const std::string& title, const models::Reflection<double>& reflection, double f = 1) {
  Panel panel{.title = title, .polar = true, .value = "ρ", .curves = {}};
  for (const double incidence : incidences)
    panel.curves.push_back(brdf_curve(incidence_label(incidence), reflection, f, incidence));
  return panel;
}

Figure fig_2_2() {
  return {.name = "fig-2-2",
          .title = "Fig. 2-2: Phong's model by R and by H, s = 0.5, d = 0.5",
          .citation = "B. T. Phong (1975), E[2.2-4]; J. F. Blinn (1977), E[2.2-5]",
          .columns = 3,
          .panels = {polar("(R·V)^30", phong_like(Model::phong, 30)),
                     polar("(N·H)^30", phong_like(Model::blinn_phong, 30)),
                     polar("(N·H)^120", phong_like(Model::blinn_phong, 120))}};
}

Figure fig_2_3() {
  return {.name = "fig-2-3",
          .title = "Fig. 2-3: Schlick's highlight and the cosine's, s = 0.5, d = 0.5",
          .citation = "C. Schlick, Graphics Gems IV (1994), E[2.2-6]; J. F. Blinn (1977), E[2.2-5]",
          .columns = 2,
          .panels = {polar("h / (h − hp + p), p = 300", phong_like(Model::schlick, 300)),
                     polar("(N·H)^120", phong_like(Model::blinn_phong, 120))}};
}

/// The right diagram compares at 80° the highlight with F, without it, and with F held at its value
/// at normal incidence.
Figure fig_2_4() {
  const auto plain = phong_like(Model::blinn_phong, 120);
  const auto fresnel = phong_like(Model::hall_greenberg, 120);
  auto held = plain;
  held.parameters[1] *= 0.32;
  return {.name = "fig-2-4",
          .title = "Fig. 2-4: what the Fresnel term does to the highlight, s = 0.5, d = 0.5",
          .citation = "R. A. Hall and D. P. Greenberg (1983), E[2.2-7], with F by E[2.2-12]",
          .columns = 3,
          .panels = {polar("(N·H)^120", plain),
                     polar("F(V·H) (N·H)^120, f = 0.32", fresnel, 0.32),
                     {.title = "light at θ = 80°",
                      .polar = true,
                      .value = "ρ",
                      .curves = {brdf_curve("F = 1", plain, 1, 80),
                                 brdf_curve("F(V·H), f = 0.32", fresnel, 0.32, 80),
                                 brdf_curve("F = 0.32", held, 1, 80)}}}};
}

/// The caption has no numbers; these f run from water to silver, with Fig. 2-4's among them.
Figure fig_2_5() {
  const models::FresnelForm& schlick = models::fresnel_forms[0];
  const models::FresnelForm& dielectric = models::fresnel_forms[1];
  Panel exact{
      .title = "exact, n from f", .angle = "angle of incidence", .value = "F", .curves = {}};
  Panel approximate{.title = "approximation f + (1 − f)(1 − u)⁵",
                    .angle = "angle of incidence",
                    .value = "F",
                    .curves = {}};
  for (const double f : {0.02, 0.04, 0.17, 0.32, 0.6, 0.9}) {
    exact.curves.push_back(
        fresnel_curve(value_label("f", f), dielectric, {models::index_from_reflectance(f)}));
    approximate.curves.push_back(fresnel_curve(value_label("f", f), schlick, {f}));
  }
  return {.name = "fig-2-5",
          .title = "Fig. 2-5: the Fresnel term and its approximation",
          .citation = "E[2.2-9] and E[2.2-11]; C. Schlick (1994), E[2.2-12]",
          .columns = 2,
          .panels = {exact, approximate}};
}

/// "Normalized" is read both ways: above by E[2.2-14], below to a peak of 1.
Figure fig_2_6() {
  const auto panel = [](const char* title, models::Slope slope) {
    Panel made{.title = title, .angle = "angle between N and H", .value = "D", .curves = {}};
    for (const double roughness : roughnesses)
      made.curves.push_back(slope_curve(value_label("σ", roughness), slope, {roughness}));
    return made;
  };
  const auto relative = [](const Panel& panel) {
    Panel made{.title = panel.title + ", relative to the peak",
               .polar = true,
               .value = "D/D(0)",
               .curves = {}};
    for (const Curve& curve : panel.curves) made.curves.push_back(relative_to_peak(curve));
    return made;
  };
  const Panel beckmann = panel("Beckmann", models::Slope::beckmann);
  const Panel schlick = panel("Schlick", models::Slope::schlick);
  return {
      .name = "fig-2-6",
      .title = "Fig. 2-6: slope distributions, ∫2hD dh = 1",
      .citation = "P. Beckmann and A. Spizzichino (1963), E[2.2-16]; C. Schlick (1994), E[2.2-17]",
      .columns = 2,
      .panels = {beckmann, schlick, relative(beckmann), relative(schlick)}};
}

Figure fig_2_8() {
  using models::Attenuation;
  Panel smooth{.title = "Torrance and Cook",
               .angle = "viewing angle",
               .value = "G",
               .curves = {attenuation_curve("any σ", Attenuation::torrance_sparrow, 0.3, 65)}};
  Panel schlick{.title = "Schlick", .angle = "viewing angle", .value = "G", .curves = {}};
  for (const double roughness : {0.1, 0.3, 0.5})
    schlick.curves.push_back(
        attenuation_curve(value_label("σ", roughness), Attenuation::schlick, roughness, 65));
  return {.name = "fig-2-8",
          .title = "Fig. 2-8: geometric attenuation, light at 65°",
          .citation =
              "K. E. Torrance and E. M. Sparrow (1967), E[2.2-18]; C. Schlick (1994), E[2.2-20]",
          .columns = 2,
          .panels = {smooth, schlick}};
}

/// Strauss's highlight in the mirror direction, where (R·V)^n is 1, without and with metalness: its
/// C_S is 1 and F. C_D = 0.
struct StraussParts {
  double fresnel, attenuation;
};

StraussParts strauss_parts(double degrees, double k_f, double k_g) {
  const double radians = degrees * std::acos(-1.0) / 180;
  const Eigen::Vector3d light(-std::sin(radians), 0, std::cos(radians));
  const Eigen::Vector3d viewer(std::sin(radians), 0, std::cos(radians));
  const auto angles = models::angles_between({0, 0, 1}, {1, 0, 0}, light, viewer);
  auto reflection = models::default_reflection(Model::strauss);
  // With o = 0 and k_s = 1 the highlight is F G(θ) G(θ′), here F G².
  const auto highlight = [&](double metalness) {
    reflection.parameters = {0.5, 0.5, 0, metalness, k_f, k_g, 1};
    return models::evaluate(reflection, angles).white;
  };
  const double whole = highlight(0);
  if (!(whole > 0)) return {0, 1};  // Along the normal, where F is 0 and hides G.
  const double fresnel = highlight(1) / whole;
  return {fresnel, std::sqrt(whole / fresnel)};
}

Figure fig_2_9() {
  struct Pair {
    const char* label;
    double k_f, k_g;
  };
  Panel attenuation{.title = "G", .angle = "angle to the normal", .value = "G", .curves = {}};
  Panel fresnel{.title = "F", .angle = "angle of incidence", .value = "F", .curves = {}};
  for (const Pair& pair : {Pair{"k_f = 1.12, k_g = 1.01 (Strauss)", 1.12, 1.01},
                           Pair{"k_f = 1.5, k_g = 1.1 (the source)", 1.5, 1.1}}) {
    Curve f{.label = pair.label, .angle = {}, .value = {}, .incidence = {}}, g = f;
    for (int i = 0; i <= 180; ++i) {
      const StraussParts parts = strauss_parts(0.5 * i, pair.k_f, pair.k_g);
      f.angle.push_back(0.5 * i);
      f.value.push_back(parts.fresnel);
      g.angle.push_back(0.5 * i);
      g.value.push_back(parts.attenuation);
    }
    attenuation.curves.push_back(g);
    fresnel.curves.push_back(f);
  }
  return {.name = "fig-2-9",
          .title = "Fig. 2-9: Strauss's attenuation and Fresnel functions",
          .citation = "P. S. Strauss (1990), E[2.2-27] as in the errata",
          .columns = 2,
          .panels = {attenuation, fresnel}};
}

/// The caption is lost: smoothness from left to right, metalness from above to below.
Figure fig_2_10() {
  Figure figure{.name = "fig-2-10",
                .title = "Fig. 2-10: Strauss's model, smoothness o and metalness p, C_D = 1",
                .citation = "P. S. Strauss (1990), E[2.2-23] to E[2.2-28]",
                .columns = 3,
                .panels = {}};
  for (const double metalness : {0.0, 0.9})
    for (const double smoothness : {0.3, 0.6, 0.85}) {
      auto reflection = models::default_reflection(Model::strauss);
      reflection.parameters[2] = smoothness;
      reflection.parameters[3] = metalness;
      figure.panels.push_back(
          polar(value_label("o", smoothness) + ", " + value_label("p", metalness), reflection));
    }
  return figure;
}

Figure fig_2_11() {
  Figure figure{.name = "fig-2-11",
                .title = "Fig. 2-11: Oren's and Nayar's diffuse reflection and Lambert's",
                .citation = "M. Oren and S. K. Nayar (1994), E[2.2-29]",
                .columns = 2,
                .panels = {}};
  for (const double incidence : {40.0, 70.0}) {
    Panel panel{.title = "light at " + incidence_label(incidence),
                .polar = true,
                .value = "ρ",
                .curves = {}};
    for (const double roughness : {0.6, 0.0})
      panel.curves.push_back(diffuse_curve(
          value_label("σ", roughness), models::DiffuseTerm::oren_nayar, {roughness}, incidence));
    figure.panels.push_back(panel);
  }
  return figure;
}

}  // namespace

std::vector<Figure> source_figures() {
  return {fig_2_2(), fig_2_3(), fig_2_4(),  fig_2_5(), fig_2_6(),
          fig_2_8(), fig_2_9(), fig_2_10(), fig_2_11()};
}

}  // namespace metamer::client
