// `metamer models`: what it says of a model, and the files that it draws.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "client/cli/commands/models/models_text.h"
#include "client/cli/output/gnuplot.h"
#include "tests/client/cli/said.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;
using client::CatalogueItem;

CatalogueItem item(const std::string& name, const std::string& folder) {
  for (const CatalogueItem& one : client::catalogue())
    if (one.name == name && one.folder == folder) return one;
  ADD_FAILURE() << "no " << folder << " " << name;
  return client::catalogue().front();
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
  ASSERT_EQ(say({"models", "plot", "lambert", "--set", "incidence=60", "--set", "diffuseness=1",
                 "-o", (folder_ / "new").string()})
                .code,
            ExitCode::done);

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
  const Said said = say({"models", "plot", "lambert", "-o", folder_.string()});
  setenv("PATH", path.c_str(), 1);

  EXPECT_EQ(said.code, ExitCode::other);
  EXPECT_EQ(said.err, "error: there is no gnuplot to draw with; install the package gnuplot-nox\n");
  EXPECT_TRUE(fs::exists(folder_ / "model-lambert.csv"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(Plot, RefusesBadWordsBeforeItWritesAnything) {
  std::vector<std::string> words = {"models", "plot", "-o", (folder_ / "new").string()};
  EXPECT_EQ(say(words).code, ExitCode::bad_input) << "no names";
  words.insert(words.end(), {"lambert", "--figures"});
  EXPECT_EQ(say(words).code, ExitCode::bad_input) << "names and --figures";
  words.back() = "--set";
  words.push_back("diffuseness=2");
  EXPECT_EQ(say(words).code, ExitCode::bad_input) << "out of range";
  EXPECT_FALSE(fs::exists(folder_ / "new"));
}

}  // namespace
}  // namespace metamer::cli
