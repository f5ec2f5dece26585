// A designer's day: fabrics from one table, a lamp as an instrument wrote it, a chair from a
// modeller; which fabric matches, and how the chair looks. No file is edited by hand but the scene.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "process.h"
#include "tests/common/mesh/gltf/gltf_text.h"

namespace metamer::test {
namespace {

const std::vector<std::string> parts = {"seat", "back", "left arm", "right arm", "legs", "piping"};
const std::vector<std::string> fabrics = {"wool", "linen", "felt", "silk", "cotton"};

/// Six boxes, each a node with a material of its own.
std::string chair() {
  GltfText text;
  std::vector<float> corners;
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4}) corners.push_back((i & bit) != 0 ? 1.f : 0.f);
  const int positions = text.vec3(corners);
  const int indices =
      text.accessor(std::vector<std::uint8_t>{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                              2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5},
                    "SCALAR", 1);
  nlohmann::json nodes = nlohmann::json::array();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    text.json["materials"].push_back(
        {{"name", "fabric of the " + parts[i]},
         {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.2, 0.1, 1}}}}});
    nlohmann::json& node = text.node_of(
        {{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", i}});
    node["name"] = parts[i];
    node["translation"] = {1.2 * static_cast<double>(i % 3), 1.2 * static_cast<double>(i / 3), 0};
    nodes.push_back(i);
  }
  text.json["scenes"][0]["nodes"] = nodes;
  return text.glb();
}

/// In percent, with decimal commas, as a spreadsheet writes it. Linen is wool, but for a bump of
/// its own.
std::string fabric_table() {
  std::ostringstream text;
  text << "Wellenl\xC3\xA4nge [nm]";
  for (const std::string& fabric : fabrics) text << ";" << fabric << " [%]";
  text << "\n";
  for (int nm = 400; nm <= 700; nm += 10) {
    text << nm;
    for (std::size_t i = 0; i < fabrics.size(); ++i) {
      const double x = (nm - 400) / 300.0;
      const double percent =
          i < 2 ? 10 + 40 * x + (i == 1 ? 4 * std::sin(19 * x) : 0)
                : 15 + 50 * std::exp(-20 * std::pow(x - 0.25 * static_cast<double>(i), 2));
      std::string number = std::to_string(percent);
      number.replace(number.find('.'), 1, ",");
      text << ";" << number;
    }
    text << "\n";
  }
  return text.str();
}

/// As a Sekonic spectrometer writes it: three bands on a low ground.
std::string lamp_export() {
  std::string text = "Spectral Data\n";
  for (int nm = 380; nm <= 780; ++nm) {
    double power = 0.0003;
    for (const double peak : {436.0, 546.0, 611.0})
      power += std::exp(-(nm - peak) * (nm - peak) / 18);
    text += "Spectral Data " + std::to_string(nm) + "[nm]," + std::to_string(power) + "\n";
  }
  return text;
}

std::string contents(const std::string& file) {
  std::ifstream from(file);
  return {std::istreambuf_iterator<char>(from), std::istreambuf_iterator<char>()};
}

TEST(DesignersDay, FabricsALampAndAChairBecomeAnAnswerAndAContactSheet) {
  const Folder folder;
  folder.write("chair.glb", chair());
  folder.write("fabrics.csv", fabric_table());
  folder.write("shop.csv", lamp_export());
  ProcessOptions here;
  here.folder = folder.path();
  const auto done = [&](const std::vector<std::string>& words) {
    const Ended ended = metamer(words, here);
    EXPECT_EQ(ended.code, 0) << words[0] << ": " << ended.err;
    return ended.out + ended.err;
  };

  // What is in the chair, and a scene of it.
  const std::string info = done({"mesh", "info", "chair.glb"});
  for (const std::string& part : parts) EXPECT_NE(info.find(part), std::string::npos) << info;
  const std::string imported = done({"import", "chair.glb", "-o", "chair.txtpb"});
  EXPECT_NE(imported.find("6 objects, 6 materials"), std::string::npos) << imported;
  EXPECT_NE(imported.find("its base colour is #"), std::string::npos) << imported;

  // The one edit by hand: each part gets a fabric.
  std::string scene = contents(folder / "chair.txtpb");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t material = scene.find("name: \"fabric of the " + parts[i] + "\"");
    const std::size_t at = scene.find("diffuse {", material);
    ASSERT_NE(at, std::string::npos);
    scene.replace(at, scene.find("\n  }", at) - at,
                  "diffuse { file: \"fabrics.csv\" entry: \"" + fabrics[i % fabrics.size()] + "\"");
  }
  folder.write("chair.txtpb", scene);
  done({"check", "chair.txtpb"});

  // Which fabric is nearest to wool, under daylight, tungsten and the shop's own lamp?
  const std::string match =
      done({"spectra", "compare", "fabrics.csv#wool", "fabrics.csv#linen", "fabrics.csv#felt",
            "fabrics.csv#silk", "--under", "D65,A,shop.csv", "-o", "match.png"});
  EXPECT_NE(match.find("linen"), std::string::npos) << match;

  // One render; the rest is relighting.
  done({"render", "chair.txtpb", "--size", "160x120", "-o", "chair.png", "--keep-factors",
        "chair.factors"});
  done({"relight", "chair.factors", "--light", "*=D65", "--light", "*=A", "--light", "*=shop.csv",
        "--material", "fabric of the seat=fabrics.csv#wool", "--material",
        "fabric of the seat=fabrics.csv#linen", "--sheet", "sheet.png"});
  for (const char* picture : {"chair.png", "match.png", "sheet.png"})
    EXPECT_EQ(contents(folder / picture).substr(1, 3), "PNG") << picture;
}

}  // namespace
}  // namespace metamer::test
