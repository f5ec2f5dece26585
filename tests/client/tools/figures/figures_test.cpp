// The numbers behind the models' diagrams, against closed forms written out here.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "client/tools/figures/curves.h"
#include "client/tools/figures/source_figures.h"

namespace metamer::client {
namespace {

double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

CatalogueItem item(const std::string& name, const std::string& folder) {
  for (const CatalogueItem& one : catalogue())
    if (one.name == name && one.folder == folder) return one;
  ADD_FAILURE() << "no " << folder << " " << name;
  return catalogue().front();
}

/// The value at an angle that the curve samples.
double at(const Curve& curve, double degrees) {
  for (std::size_t i = 0; i < curve.angle.size(); ++i)
    if (curve.angle[i] == degrees) return curve.value[i];
  ADD_FAILURE() << "no sample at " << degrees;
  return NAN;
}

std::string refusal(const std::string& word, const CatalogueItem& of) {
  const auto values = parse_values({word}, {of});
  return values ? "" : values.error().message;
}

TEST(Catalogue, HasEveryLineOfTheRegistry) {
  std::size_t lines = models::fresnel_forms.size();
  for (const auto kind :
       {models::Kind::model, models::Kind::diffuse, models::Kind::slope, models::Kind::attenuation})
    lines += models::registry(kind).size();
  EXPECT_EQ(catalogue().size(), lines);
}

TEST(Catalogue, GivesEveryThingOfAName) {
  const auto found = find_items("schlick");
  ASSERT_TRUE(found);
  std::string kinds;
  for (const CatalogueItem& one : *found) kinds += std::string(one.folder) + " ";
  EXPECT_EQ(kinds, "model slope attenuation fresnel ");
}

TEST(Catalogue, SuggestsANameForAnUnknownOne) {
  const auto found = find_items("blin_phong");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().message,
            "there is no model named \"blin_phong\"; did you mean \"blinn_phong\"?");
}

TEST(FigureValues, RefusesWhatNothingCanTake) {
  const CatalogueItem phong = item("blinn_phong", "model");
  EXPECT_EQ(refusal("shinines=3", phong),
            "nothing that is drawn has a parameter \"shinines\"; did you mean \"shininess\"?");
  EXPECT_EQ(refusal("shininess=0.5", phong),
            "shininess of blinn_phong must lie in 1..1e+06; the nearest to 0.5 is 1");
  EXPECT_EQ(refusal("shininess=2e6", phong),
            "shininess of blinn_phong must lie in 1..1e+06; the nearest to 2e+06 is 1e+06");
  EXPECT_EQ(refusal("shininess=3x", phong), "shininess: \"3x\" is not a number");
  EXPECT_EQ(refusal("shininess=nan", phong), "shininess: \"nan\" is not a number");
  EXPECT_EQ(refusal("shininess", phong),
            "\"shininess\" is not PARAMETER=VALUE, such as shininess=120");
  EXPECT_EQ(refusal("shininess=120", phong), "");
}

TEST(Curves, BlinnPhongInTheMirrorDirectionIsDiffusePlusWhole) {
  const Figure figure = figure_of(item("blinn_phong", "model"),
                                  {{"diffuseness", 0.25}, {"specularness", 0.5}, {"shininess", 9}});
  ASSERT_EQ(figure.panels.at(0).curves.size(), 4u);
  const Curve& curve = figure.panels[0].curves[3];
  EXPECT_EQ(curve.label, "θ = 60°");
  EXPECT_NEAR(at(curve, 60), 0.25 * 0.5 + 0.5, 1e-14);
  // Back towards the light the bisector is the light's own direction.
  EXPECT_NEAR(at(curve, -60), 0.25 * 0.5 + 0.5 * std::pow(0.5, 9), 1e-14);
  EXPECT_NEAR(at(curve, 0), 0.25 * 0.5 + 0.5 * std::pow(cosine(30), 9), 1e-14);
}

TEST(Curves, PhongTakesTheMirroredDirectionItself) {
  const Figure figure =
      figure_of(item("phong", "model"), {{"shininess", 30}, {"incidence", 40}, {"f", 1}});
  ASSERT_EQ(figure.panels.at(0).curves.size(), 1u);
  const Curve& curve = figure.panels[0].curves[0];
  EXPECT_NEAR(at(curve, 50), 0.5 * cosine(40) + 0.5 * std::pow(cosine(10), 30), 1e-14);
}

TEST(Curves, AnisotropicModelsDifferAlongAndAcrossTheTangent) {
  const Figure figure = figure_of(item("ward_phong", "model"), {{"incidence", 0}});
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_NEAR(at(figure.panels[0].curves.at(0), 20), 0.5 + 0.5 * std::pow(cosine(10), 20), 1e-12);
  EXPECT_NEAR(at(figure.panels[1].curves.at(0), 20), 0.5 + 0.5 * std::pow(cosine(10), 200), 1e-12);
}

TEST(Curves, SlopesAreTheirEquations) {
  const Figure figure = figure_of(item("beckmann", "slope"), {{"roughness", 0.4}});
  const double h = cosine(25);
  const double expected = std::exp((h * h - 1) / (0.16 * h * h)) / (0.16 * std::pow(h, 4));
  EXPECT_NEAR(at(figure.panels.at(0).curves.at(0), 25), expected, 1e-13);
  EXPECT_NEAR(at(figure.panels.at(1).curves.at(0), 25), expected * 0.16, 1e-13);
}

TEST(Curves, AttenuationIsGWithoutTheCosineThatItCancels) {
  const Figure figure = figure_of(item("schlick", "attenuation"), {{"incidence", 65}});
  ASSERT_EQ(figure.panels.size(), 1u);
  const double c = 0.3 * std::sqrt(2 / std::numbers::pi);
  const auto g = [&](double x) { return x / (x - c * x + c); };
  EXPECT_NEAR(at(figure.panels[0].curves.at(1), 70), g(cosine(65)) * g(cosine(70)), 1e-14);
  EXPECT_NEAR(at(figure.panels[0].curves.at(1), 90), 0, 1e-14);
}

TEST(Curves, FresnelRunsFromFToOne) {
  const Figure figure = figure_of(item("schlick", "fresnel"), {{"f", 0.32}});
  const Curve& curve = figure.panels.at(0).curves.at(0);
  EXPECT_DOUBLE_EQ(at(curve, 0), 0.32);
  EXPECT_DOUBLE_EQ(at(curve, 60), 0.32 + 0.68 / 32);
  EXPECT_NEAR(at(curve, 90), 1, 1e-14);
  const Figure glass = figure_of(item("dielectric", "fresnel"), {{"n", 1.5}});
  EXPECT_NEAR(at(glass.panels.at(0).curves.at(0), 0), 0.04, 1e-15);
}

TEST(Figures, AreThoseOfTheSource) {
  std::string names;
  for (const Figure& figure : source_figures()) names += figure.name + " ";
  EXPECT_EQ(names, "fig-2-2 fig-2-3 fig-2-4 fig-2-5 fig-2-6 fig-2-8 fig-2-9 fig-2-10 fig-2-11 ");
}

TEST(Figures, HoldFiniteValuesBelowTheirScale) {
  std::vector<Figure> figures = source_figures();
  for (const CatalogueItem& one : catalogue()) figures.push_back(figure_of(one, {}));
  for (const Figure& figure : figures)
    for (const Panel& panel : figure.panels) {
      ASSERT_FALSE(panel.curves.empty()) << figure.name;
      const double top = scale_of(figure, panel.polar).top;
      for (const Curve& curve : panel.curves)
        for (const double value : curve.value) {
          ASSERT_GE(value, 0) << figure.name << ", " << curve.label;
          ASSERT_LE(value, top * (1 + 1e-9)) << figure.name << ", " << curve.label;
        }
    }
}

TEST(Figures, StraussFunctionsAreThoseOfTheErrata) {
  const Figure figure = source_figures().at(6);
  ASSERT_EQ(figure.name, "fig-2-9");
  const auto square = [](double x) { return x * x; };
  const double k_g = 1.1, k_f = 1.5, x = 0.7;
  const double g =
      (1 / square(1 - k_g) - 1 / square(x - k_g)) / (1 / square(1 - k_g) - 1 / square(k_g));
  const double f =
      (1 / square(x - k_f) - 1 / square(k_f)) / (1 / square(1 - k_f) - 1 / square(k_f));
  EXPECT_NEAR(at(figure.panels.at(0).curves.at(1), 63), g, 1e-12);
  EXPECT_NEAR(at(figure.panels.at(1).curves.at(1), 63), f, 1e-12);
  EXPECT_EQ(at(figure.panels[0].curves[1], 0), 1);
  EXPECT_EQ(at(figure.panels[1].curves[1], 0), 0);
}

TEST(Scale, StopsAtRoundNumbers) {
  const auto top = [](double most) {
    Figure figure;
    figure.panels = {{.title = "", .curves = {{"", {0, 1}, {0, most}, {}}}}};
    return scale_of(figure, false).top;
  };
  EXPECT_DOUBLE_EQ(top(1), 1);
  EXPECT_DOUBLE_EQ(top(25), 25);
  EXPECT_DOUBLE_EQ(top(0.83), 1);
  EXPECT_DOUBLE_EQ(top(6.2), 8);
}

TEST(Csv, QuotesWhatHoldsACommaAndKeepsEveryBit) {
  Figure figure;
  figure.panels = {{.title = "a, \"b\"", .curves = {{"σ = 0.3", {0.5}, {0.1 + 0.2}, {}}}}};
  EXPECT_EQ(csv_text(figure),
            "panel,curve,degrees,value\n\"a, \"\"b\"\"\",σ = 0.3,0.5,0.30000000000000004\n");
}

}  // namespace
}  // namespace metamer::client
