#include "common/scene/fluorescence.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <map>

namespace metamer::test {
namespace {

const std::map<std::string, std::string> files = {
    {"ok.csv", "ex,400,450\n300,.001,.001\n350,.001,.001\n"},
    {"much.csv", "ex,400,450\n300,.001,.001\n350,.02,.02\n"},
    {"wrong.csv", "ex,400,450\n300,.001,.001\n350,.02,x\n"}};

const AssetReader reader = [](const std::string& name) -> Result<std::string> {
  const auto found = files.find(name);
  if (found == files.end()) return problem("no such file");
  return found->second;
};

/// What is wrong with a scene of such a material, with and without its files.
std::vector<std::string> faults_of(const std::string& material) {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(
      "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { standard: "
      "'D65' } } material { name: 'm' " +
          material + " } object { name: 'o' material: 'm' sphere { radius: 1 } }",
      &scene));
  std::vector<Problem> problems = validate_scene(scene);
  if (problems.empty()) problems = validate_spectra(scene, reader);
  std::vector<std::string> all;
  for (const Problem& one : problems) all.push_back(one.field + ": " + one.message);
  return all;
}

using Faults = std::vector<std::string>;

const std::string spectra =
    "excitation { samples { wavelength: [300, 400] value: [0.5, 0.5] } interpolation: LINEAR } "
    "emission { samples { wavelength: [420, 500] value: [1, 1] } interpolation: LINEAR } ";

TEST(SceneFluorescence, IsAFileOrSpectraWithAYield) {
  EXPECT_EQ(faults_of("fluorescence { file: 'ok.csv' }"), Faults{});
  EXPECT_EQ(faults_of("fluorescence { " + spectra + " quantum_yield: 1 }"), Faults{});
  EXPECT_EQ(faults_of("fluorescence {}"),
            Faults{"material[0].fluorescence: fluorescence needs a file, or excitation, emission "
                   "and quantum_yield"});
  EXPECT_EQ(faults_of("fluorescence { " + spectra + " }"),
            Faults{"material[0].fluorescence: fluorescence needs a file, or excitation, emission "
                   "and quantum_yield"});
  EXPECT_EQ(faults_of("fluorescence { file: 'ok.csv' quantum_yield: 1 }"),
            Faults{"material[0].fluorescence: fluorescence takes either a file or excitation, "
                   "emission and quantum_yield, not both"});
  EXPECT_EQ(faults_of("fluorescence { " + spectra + " quantum_yield: 1.5 }"),
            Faults{"material[0].fluorescence.quantum_yield: quantum_yield must lie in 0..1 (it is "
                   "1.5)"});
  EXPECT_EQ(faults_of("fluorescence { excitation { constant: 1.5 } "
                      "emission { samples { wavelength: [500, 600] value: [1, 1] } } "
                      "quantum_yield: 1 }"),
            Faults{"material[0].fluorescence.excitation.constant: an excitation must lie in 0..1 "
                   "(it is 1.5)"});
  EXPECT_EQ(faults_of("fluorescence { excitation { constant: 1 } emission { constant: 1 } "
                      "quantum_yield: 1 }"),
            Faults{"material[0].fluorescence.emission.constant: an emission of a fluorescence "
                   "needs wavelengths: samples or a file"});
}

TEST(SceneFluorescence, KeepsTheLawOfEnergyWithDiffuse) {
  // 0.02 per nm over 50 nm is all of the light.
  EXPECT_EQ(faults_of("fluorescence { file: 'much.csv' }"), Faults{});
  EXPECT_EQ(faults_of("diffuse { constant: 0.1 } fluorescence { file: 'much.csv' }"),
            Faults{"material[0].fluorescence: more light comes out than in at 350 nm: 0.1 is "
                   "reflected and 1 re-radiated, in sum at most 1"});
}

TEST(SceneFluorescence, HasItsFilesFaultsLocated) {
  const auto faults = faults_of("fluorescence { file: 'wrong.csv' }");
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].find("material[0].fluorescence.file: "), 0u) << faults[0];
  EXPECT_EQ(faults_of("fluorescence { file: 'none.csv' }"),
            Faults{"material[0].fluorescence.file: no such file"});
}

TEST(SceneFluorescence, SaysHowMuchIsLeftOut) {
  v1::Fluorescence message;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(
      "excitation { samples { wavelength: [400, 600] value: [1, 1] } interpolation: LINEAR } "
      "emission { samples { wavelength: [400, 600] value: [1, 1] } interpolation: LINEAR } "
      "quantum_yield: 1",
      &message));
  const auto loaded = load_fluorescence(message, "f", reader);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->notes,
            std::vector<std::string>{"50 % of its emission would be at shorter wavelengths than "
                                     "what it absorbs of white light, and is left out"});
}

}  // namespace
}  // namespace metamer::test
