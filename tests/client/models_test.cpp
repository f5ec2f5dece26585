// `metamer models`: what it says of a model, and the numbers behind its diagrams against closed
// forms written out here.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "client/cli/commands.h"
#include "client/cli/curves.h"
#include "client/cli/gnuplot.h"
#include "client/cli/models_text.h"
#include "client/cli/source_figures.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;

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

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

TEST(ModelsText, ShowsEquationPaperTraitsAndParameters) {
  EXPECT_EQ(show_text(item("beckmann", "slope")),
            "beckmann: slope distribution\n"
            "  D = exp((h² − 1)/(σ²h²)) / (σ²h⁴)\n"
            "  P. Beckmann and A. Spizzichino, The scattering of electromagnetic waves from rough "
            "surfaces "
            "(1963); E[2.2-16]\n"
            "  Normalised: ∫2hD dh = 1.\n"
            "\n"
            "  parameter  default  range       meaning\n"
            "  roughness  0.3      0.001 to 1  σ, the slope of the facets: small is smooth\n");
}

TEST(ModelsText, ListsTheFresnelFormsUnderTheirKind) {
  EXPECT_EQ(
      list_text({item("schlick", "fresnel")}),
      "Fresnel term\n"
      "  schlick  C. Schlick, An inexpensive BRDF model for physically-based rendering (1994); "
      "E[2.2-12]\n");
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

TEST(Set, RefusesWhatNothingCanTake) {
  const CatalogueItem phong = item("blinn_phong", "model");
  EXPECT_EQ(
      refusal("shinines=3", phong),
      "--set: nothing that is drawn has a parameter \"shinines\"; did you mean \"shininess\"?");
  EXPECT_EQ(refusal("shininess=0.5", phong),
            "--set: shininess of blinn_phong must lie in 1..1e+06; the nearest to 0.5 is 1");
  EXPECT_EQ(refusal("shininess=2e6", phong),
            "--set: shininess of blinn_phong must lie in 1..1e+06; the nearest to 2e+06 is 1e+06");
  EXPECT_EQ(refusal("shininess=3x", phong), "--set: shininess: \"3x\" is not a number");
  EXPECT_EQ(refusal("shininess=nan", phong), "--set: shininess: \"nan\" is not a number");
  EXPECT_EQ(refusal("shininess", phong),
            "--set: \"shininess\" is not PARAMETER=VALUE, such as shininess=120");
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

/// A folder that goes with the test.
class Plot : public testing::Test {
 protected:
  Plot() {
    std::string pattern = (fs::temp_directory_path() / "metamer-plot-XXXXXX").string();
    if (!mkdtemp(pattern.data())) ADD_FAILURE() << "no folder";
    folder_ = pattern;
  }
  ~Plot() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(Plot, WritesNumbersAndPictures) {
  PlotOptions options;
  options.names = {"lambert"};
  options.set = {"incidence=60", "diffuseness=1"};
  options.folder = (folder_ / "new").string();
  ASSERT_EQ(plot_models(options), ExitCode::done);

  // Lambert's ρ is N·L in all directions.
  std::istringstream lines(contents(folder_ / "new" / "model-lambert.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "panel,curve,degrees,value");
  int count = 0;
  for (; std::getline(lines, line); ++count)
    EXPECT_NEAR(std::stod(line.substr(line.rfind(',') + 1)), 0.5, 1e-14) << line;
  EXPECT_EQ(count, 361);

  const std::string png = contents(folder_ / "new" / "model-lambert.png");
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
  EXPECT_GT(png.size(), 5000u);
}

TEST_F(Plot, AFailedPictureLeavesTheOldOneAndNothingElse) {
  const fs::path file = folder_ / "picture.png";
  ASSERT_TRUE(write_text_file(file, "old"));
  const auto drawn = draw_png("this is no script\n", file);
  ASSERT_FALSE(drawn);
  EXPECT_EQ(drawn.error().message.substr(0, 20), "gnuplot drew nothing");
  EXPECT_EQ(contents(file), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(Plot, WithoutGnuplotKeepsTheNumbers) {
  const std::string path = getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  PlotOptions options;
  options.names = {"lambert"};
  options.folder = folder_.string();
  testing::internal::CaptureStderr();
  const ExitCode code = plot_models(options);
  const std::string said = testing::internal::GetCapturedStderr();
  setenv("PATH", path.c_str(), 1);

  EXPECT_EQ(code, ExitCode::other);
  EXPECT_EQ(said, "error: there is no gnuplot to draw with; install the package gnuplot-nox\n");
  EXPECT_TRUE(fs::exists(folder_ / "model-lambert.csv"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(Plot, RefusesBadWordsBeforeItWritesAnything) {
  PlotOptions options;
  options.folder = (folder_ / "new").string();
  EXPECT_EQ(plot_models(options), ExitCode::bad_input) << "no names";
  options.names = {"lambert"};
  options.set = {"diffuseness=2"};
  EXPECT_EQ(plot_models(options), ExitCode::bad_input) << "out of range";
  options.set.clear();
  options.figures = true;
  EXPECT_EQ(plot_models(options), ExitCode::bad_input) << "names and --figures";
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

}  // namespace
}  // namespace metamer::cli
