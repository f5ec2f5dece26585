#include "common/models/registry.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/models/reference.h"

namespace metamer::models {
namespace {

constexpr Kind kinds[] = {Kind::model, Kind::diffuse, Kind::slope, Kind::attenuation};

TEST(ModelRegistry, DefaultsLieInTheirRangesAndNamesAreUnique) {
  for (const Kind kind : kinds) {
    std::vector<std::string> names;
    std::vector<int> numbers;
    for (const Entry& entry : registry(kind)) {
      names.emplace_back(entry.name);
      numbers.push_back(entry.number);
      EXPECT_NE(std::string(entry.citation), "") << entry.name;
      EXPECT_NE(std::string(entry.equation), "") << entry.name;
      EXPECT_LE(entry.parameters.size(), max_parameters) << entry.name;
      for (const Parameter& parameter : entry.parameters) {
        EXPECT_LE(parameter.min, parameter.default_value) << entry.name << "." << parameter.name;
        EXPECT_GE(parameter.max, parameter.default_value) << entry.name << "." << parameter.name;
      }
    }
    std::sort(names.begin(), names.end());
    std::sort(numbers.begin(), numbers.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << kind_name(kind);
    EXPECT_EQ(std::adjacent_find(numbers.begin(), numbers.end()), numbers.end()) << kind_name(kind);
  }
}

// By hand, so that no mistake is made twice, in shaders/ and in tests/extremes/definitions.py.
TEST(BlinnPhong, IsItsEquation) {
  // E[2.2-5]: d N·L = 0.7 × 0.5; s (N·H)^n = 0.3 × 0.9^60.
  Reflection<double> reflection;
  reflection.model = Model::blinn_phong;
  reflection.parameters = {0.7, 0.3, 60};
  Angles<double> angles{};
  angles.n_dot_l = 0.5;
  angles.n_dot_h = 0.9;
  angles.n_h_versine = 0.1;
  const auto lobes = evaluate(reflection, angles);
  EXPECT_DOUBLE_EQ(lobes.diffuse, 0.35);
  EXPECT_NEAR(lobes.specular, 0.3 * 1.797010299914431e-3, 1e-17);
  EXPECT_EQ(lobes.white, 0);
}

TEST(Lambert, HasNoHighlight) {
  Reflection<double> reflection;
  reflection.model = Model::lambert;
  reflection.parameters = {0.7, 0.3};
  Angles<double> angles{};
  angles.n_dot_l = 0.5;
  angles.n_dot_h = 1;
  const auto lobes = evaluate(reflection, angles);
  EXPECT_DOUBLE_EQ(lobes.diffuse, 0.35);
  EXPECT_EQ(lobes.specular, 0);
}

}  // namespace
}  // namespace metamer::models
