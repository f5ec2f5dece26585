// One quad under one light, against E[2.2-5], E[3.2-2], E[3.2-3] and E[3.2-4] with plain loops in
// f64: nothing here but the CIE's tables is the renderer's.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>

#include "common/spectral/cie.h"
#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

using Triple = std::array<double, 3>;
using Table = std::vector<std::pair<double, double>>;  // nm, value

/// The quad lies in z = 0; the camera sees so small a part of it that the light comes from one
/// direction, and the viewer's is the normal.
const Triple light_position = {3, 0, 4};

const Table paint = {{420, 0.2}, {500, 0.45}, {590, 0.9}, {680, 0.6}};
const Table gloss = {{400, 0.9}, {700, 0.5}};

Table table(const Spectrum& spectrum) {
  Table result;
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i)
    result.emplace_back(spectrum.nm[i], spectrum.values[i]);
  return result;
}

/// Linear between the samples; outside, the end value or 0.
double value_at(const Table& table, double nm, bool hold) {
  if (nm < table.front().first) return hold ? table.front().second : 0;
  if (nm > table.back().first) return hold ? table.back().second : 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    if (nm > table[i].first) continue;
    const double t = (nm - table[i - 1].first) / (table[i].first - table[i - 1].first);
    return table[i - 1].second + t * (table[i].second - table[i - 1].second);
  }
  return table.front().second;
}

/// Fig. 4-2.
double cell_width(const std::vector<double>& nm, std::size_t i) {
  if (i == 0) return nm[1] - nm[0];
  if (i + 1 == nm.size()) return nm[i] - nm[i - 1];
  return (nm[i + 1] - nm[i - 1]) / 2;
}

/// XYZ of `diffuse_weight` C_D + `specular_weight` C_S under an illuminant of luminance 0.9.
Triple expected(const std::string& illuminant, const Observer& observer,
                const std::vector<double>& nm, double diffuse_weight, double specular_weight) {
  const Table light = table(*cie::illuminant(illuminant));
  const auto& functions = observer.functions();
  const std::array<Table, 3> bars = {table(functions[0]), table(functions[1]), table(functions[2])};
  Triple sum{};
  double light_y = 0;
  for (std::size_t i = 0; i < nm.size(); ++i) {
    const double power = value_at(light, nm[i], false) * cell_width(nm, i);
    const double reflected = diffuse_weight * value_at(paint, nm[i], true) +
                             specular_weight * value_at(gloss, nm[i], true);
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += value_at(bars[c], nm[i], false) * power * reflected;
    light_y += value_at(bars[1], nm[i], false) * power;
  }
  for (double& value : sum) value *= 0.9 / light_y;
  return sum;
}

std::string samples(const Table& table) {
  std::ostringstream text;
  text << "samples {";
  for (const auto& [nm, value] : table) text << " wavelength: " << nm << " value: " << value;
  text << " }";
  return text.str();
}

std::string scene_text(const std::string& material, const std::string& light) {
  return "camera { eye { z: 5 } vertical_fov: 0.0001 }\n"
         "light { name: \"lamp\" position { x: 3 z: 4 } spectrum { standard: \"D65\" }\n"
         "  luminance: 0.9 " +
         light +
         " }\n"
         "material { name: \"paint\" diffuse { " +
         samples(paint) + " } " + material +
         " }\n"
         "object { material: \"paint\" quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } } }\n"
         "settings { width: 9 height: 9 spp: 4 method { point { from: 400 to: 700 step: 5 lights: "
         "SAMPLES } } }\n";
}

std::vector<double> uniform(double from, double to, double step) {
  std::vector<double> nm;
  for (int i = 0; from + i * step <= to; ++i) nm.push_back(from + i * step);
  return nm;
}

class ClosedForm : public testing::Test {
 protected:
  void expect_everywhere(const std::string& scene, const std::vector<std::string>& overrides,
                         const Triple& xyz) {
    const std::string file = folder / "quad.exr";
    std::vector<std::string> words = {"render", scene, "-o", file, "--exr", "xyz"};
    words.insert(words.end(), overrides.begin(), overrides.end());
    const Ended ended = daemon.metamer(words);
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Image image = read_exr(file);
    ASSERT_EQ(image.channels, (std::vector<std::string>{"X", "Y", "Z"}));
    ASSERT_EQ(image.pixels.size(), 9u * 9 * 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const double error = std::abs(image.pixels[i] - xyz[i % 3]) / xyz[i % 3];
      worst = std::max(worst, error);
      ASSERT_LT(error, 1e-5) << "channel " << i % 3 << ": " << image.pixels[i] << " is not "
                             << xyz[i % 3];
    }
  }

  Daemon daemon;
  Folder folder;
  double worst = 0;
};

struct Sampling {
  std::vector<std::string> words;
  std::vector<double> nm;
};

TEST_F(ClosedForm, DiffuseQuadUnderAPointLight) {
  const std::string scene = folder.write("quad.txtpb", scene_text("diffuseness: 0.7", ""));
  const double n_dot_l = light_position[2] / 5;
  const std::vector<Sampling> samplings = {
      {{"--samples", "400:700:5"}, uniform(400, 700, 5)},
      {{"--samples", "380:780:1"}, uniform(380, 780, 1)},
      {{"--wavelengths", "400,436,500,546,611,700"}, {400, 436, 500, 546, 611, 700}}};
  const std::vector<std::pair<std::string, Observer>> observers = {
      {"cie-1931-2deg", cie::observer_1931()}, {"cie-1964-10deg", cie::observer_1964()}};
  for (const std::string illuminant : {"A", "D65", "F11"}) {
    for (const auto& [name, observer] : observers) {
      for (const Sampling& sampling : samplings) {
        SCOPED_TRACE(illuminant + ", " + name + ", " + sampling.words[1]);
        std::vector<std::string> words = {"--light", "lamp=" + illuminant, "--observer",
                                          name,      "--point-lights",     "samples"};
        words.insert(words.end(), sampling.words.begin(), sampling.words.end());
        expect_everywhere(scene, words,
                          expected(illuminant, observer, sampling.nm, 0.7 * n_dot_l, 0));
      }
    }
  }
  RecordProperty("worst_relative_error_e9", static_cast<int>(worst * 1e9));
}

TEST_F(ClosedForm, HighlightOfBlinnPhong) {
  const std::string scene = folder.write(
      "quad.txtpb",
      scene_text("specular { " + samples(gloss) +
                     " } diffuseness: 0.6 specularness: 0.4 blinn_phong { shininess: 12 }",
                 ""));
  // H lies halfway between L = (0.6, 0, 0.8) and V = N = (0, 0, 1).
  const double n_dot_l = light_position[2] / 5;
  const double n_dot_h = 1.8 / std::hypot(0.6, 1.8);
  expect_everywhere(scene, {"--light", "*=A"},
                    expected("A", cie::observer_1931(), uniform(400, 700, 5), 0.6 * n_dot_l,
                             0.4 * std::pow(n_dot_h, 12)));
}

TEST_F(ClosedForm, LightFallsWithTheSquareOfItsDistance) {
  const std::string scene =
      folder.write("quad.txtpb", scene_text("diffuseness: 0.7", "reference_distance: 2.5"));
  const double n_dot_l = light_position[2] / 5;
  expect_everywhere(
      scene, {},
      expected("D65", cie::observer_1931(), uniform(400, 700, 5), 0.7 * n_dot_l * 0.25, 0));
}

}  // namespace
}  // namespace metamer::test
