// What holds for every model of the registry.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "server/models/models.h"

namespace metamer::models {
namespace {

/// Random angles and parameters over a model's whole range, its ends included.
class Random {
 public:
  double cosine() { return at_end() ? end_ : uniform_(engine_); }
  double between(double min, double max) {
    if (at_end()) return end_ == 0 ? min : max;
    // Parameters that span decades are drawn by decade.
    return min > 0 && max / min > 1e3 ? min * std::pow(max / min, uniform_(engine_))
                                      : min + (max - min) * uniform_(engine_);
  }
  Parameters64 parameters(const ModelInfo& info) {
    Parameters64 result{uniform_(engine_), uniform_(engine_)};
    for (std::size_t i = 0; i < info.parameters.size(); ++i)
      result[2 + i] = between(info.parameters[i].min, info.parameters[i].max);
    return result;
  }

 private:
  bool at_end() {
    const double draw = uniform_(engine_);
    end_ = draw < 0.02 ? 0 : 1;
    return draw < 0.04;
  }
  std::mt19937_64 engine_{20041};
  std::uniform_real_distribution<double> uniform_{0, 1};
  double end_ = 0;
};

/// The f32 values that both builds are given.
Parameters to_f32(Parameters64& parameters) {
  Parameters result{};
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = static_cast<float>(parameters[i]);
    parameters[i] = result[i];
  }
  return result;
}

TEST(ModelLaws, LobesAreFiniteAndNotNegativeAndTheF32BuildAgreesWithF64) {
  for (const ModelInfo& info : registry()) {
    Random random;
    for (int i = 0; i < 125'000; ++i) {
      Parameters64 parameters64 = random.parameters(info);
      const Parameters parameters = to_f32(parameters64);
      AngleLanes angles{};
      for (int lane = 0; lane < lane_count; ++lane) {
        angles.n_dot_l[lane] = static_cast<float>(random.cosine());
        angles.n_dot_h[lane] = static_cast<float>(random.cosine());
      }
      const LobeLanes lobes = evaluate(info.model, parameters, angles);
      for (int lane = 0; lane < lane_count; ++lane) {
        const Lobes64 exact =
            evaluate(info.model, parameters64, {angles.n_dot_l[lane], angles.n_dot_h[lane]});
        const auto agrees = [](float f32, double f64) {
          return std::isfinite(f32) && f32 >= 0 && std::abs(f32 - f64) <= 2e-6 * f64 + 1e-37;
        };
        ASSERT_TRUE(agrees(lobes.diffuse[lane], exact.diffuse) &&
                    agrees(lobes.specular[lane], exact.specular) &&
                    agrees(lobes.white[lane], exact.white))
            << info.name << " at N·L " << angles.n_dot_l[lane] << ", N·H " << angles.n_dot_h[lane]
            << ": " << lobes.specular[lane] << " is not " << exact.specular;
      }
    }
  }
}

TEST(ModelLaws, ALightBehindTheSurfaceGivesNothing) {
  for (const ModelInfo& info : registry()) {
    Random random;
    for (int i = 0; i < 1000; ++i) {
      const Lobes64 lobes =
          evaluate(info.model, random.parameters(info), Angles64{0, random.cosine()});
      ASSERT_EQ(lobes.diffuse + lobes.specular + lobes.white, 0) << info.name;
    }
  }
}

TEST(ModelLaws, EachLaneIsItsOwn) {
  for (const ModelInfo& info : registry()) {
    Random random;
    Parameters64 parameters64 = random.parameters(info);
    const Parameters parameters = to_f32(parameters64);
    AngleLanes angles{};
    for (int lane = 0; lane < lane_count; ++lane) {
      angles.n_dot_l[lane] = 0.1f * static_cast<float>(lane + 1);
      angles.n_dot_h[lane] = 1 - 0.01f * static_cast<float>(lane);
    }
    const LobeLanes together = evaluate(info.model, parameters, angles);
    for (int lane = 0; lane < lane_count; ++lane) {
      AngleLanes alone{broadcast(angles.n_dot_l[lane]), broadcast(angles.n_dot_h[lane])};
      const LobeLanes one = evaluate(info.model, parameters, alone);
      EXPECT_EQ(one.diffuse[7 - lane], together.diffuse[lane]) << info.name;
      EXPECT_EQ(one.specular[7 - lane], together.specular[lane]) << info.name;
    }
  }
}

TEST(ModelRegistry, DefaultsLieInTheirRangesAndNamesAreUnique) {
  std::vector<std::string> names;
  std::vector<int> numbers;
  for (const ModelInfo& info : registry()) {
    names.emplace_back(info.name);
    numbers.push_back(info.number);
    EXPECT_NE(std::string(info.citation), "");
    EXPECT_LE(info.parameters.size() + 2, max_parameters);
    for (const ParameterInfo& parameter : info.parameters) {
      EXPECT_LE(parameter.min, parameter.default_value) << info.name << "." << parameter.name;
      EXPECT_GE(parameter.max, parameter.default_value) << info.name << "." << parameter.name;
    }
  }
  std::sort(names.begin(), names.end());
  std::sort(numbers.begin(), numbers.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  EXPECT_EQ(std::adjacent_find(numbers.begin(), numbers.end()), numbers.end());
}

TEST(BlinnPhong, IsItsEquation) {
  // E[2.2-5] by hand: d N·L = 0.7 × 0.5; s (N·H)^n = 0.3 × 0.9^60.
  const Lobes64 lobes = evaluate(Model::blinn_phong, Parameters64{0.7, 0.3, 60}, {0.5, 0.9});
  EXPECT_DOUBLE_EQ(lobes.diffuse, 0.35);
  EXPECT_NEAR(lobes.specular, 0.3 * 1.797010299914431e-3, 1e-17);
  EXPECT_EQ(lobes.white, 0);
}

TEST(Lambert, HasNoHighlight) {
  const Lobes64 lobes = evaluate(Model::lambert, Parameters64{0.7, 0.3}, {0.5, 1});
  EXPECT_DOUBLE_EQ(lobes.diffuse, 0.35);
  EXPECT_EQ(lobes.specular, 0);
}

}  // namespace
}  // namespace metamer::models
