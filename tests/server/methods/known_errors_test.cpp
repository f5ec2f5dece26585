// The worst ΔE00 over the 15 CRI test colours of each way to carry colour, 400 to 700 nm, against 1
// nm: an independent calculation's figures, to the two digits that it gives.

#include <gtest/gtest.h>

#include <cmath>

#include "common/color/lab.h"
#include "common/color/srgb.h"
#include "common/color/xyz.h"
#include "common/spectral/cie.h"
#include "server/methods/linear_basis.h"
#include "tests/server/methods/color_error.h"
#include "tests/server/methods/methods.h"

namespace metamer {
namespace {

const Observer& observer_choice = cie::observer_1931();

/// That calculation joined the 5 nm samples of the observer's tables by straight lines.
ObserverWeights observer_by_5_nm(const Wavelengths& wavelengths) {
  ObserverWeights result;
  for (std::size_t c = 0; c < result.weights.size(); ++c) {
    const Spectrum& fine = observer_choice.functions()[c];
    Spectrum coarse;
    for (std::size_t i = 0; i < fine.nm.size(); i += 5) {
      coarse.nm.push_back(fine.nm[i]);
      coarse.values.push_back(fine.values[i]);
    }
    result.weights[c] = resample(coarse, wavelengths.nm(), Outside::zero).values;
    for (std::size_t i = 0; i < wavelengths.size(); ++i)
      result.weights[c][i] *= wavelengths.widths()[i];
  }
  return result;
}

/// A light and everything that it lights, at some wavelengths.
struct Booth {
  Wavelengths wavelengths;
  ObserverWeights observer;
  std::vector<double> light;                  ///< With luminance 1 by its own samples.
  std::vector<std::vector<double>> surfaces;  ///< The test colours.

  Booth(const std::string& illuminant, double step)
      : wavelengths(*Wavelengths::uniform(400, 700, step)),
        observer(observer_by_5_nm(wavelengths)),
        light(resample(*cie::illuminant(illuminant), wavelengths.nm(), Outside::zero).values) {
    const double scale = luminance_scale(observer, light, 1);
    for (double& value : light) value *= scale;
    for (int i = 0; i < 15; ++i)
      surfaces.push_back(resample(*cie::test_color(cie::test_color_names()[std::size_t(i)]),
                                  wavelengths.nm(), Outside::hold)
                             .values);
  }

  Xyz white() const { return to_xyz(observer, light); }
  Xyz seen(std::size_t i) const {
    std::vector<double> reflected = light;
    for (std::size_t k = 0; k < reflected.size(); ++k) reflected[k] *= surfaces[i][k];
    return to_xyz(observer, reflected);
  }
};

template <class Colour>
double worst(const Booth& reference, Colour colour) {
  double most = 0;
  for (std::size_t i = 0; i < reference.surfaces.size(); ++i)
    most = std::max(most, delta_e_00(to_lab(colour(i), reference.white()),
                                     to_lab(reference.seen(i), reference.white())));
  return most;
}

double of_uniform(const std::string& illuminant, double step) {
  const Booth booth(illuminant, step);
  return worst(Booth(illuminant, 1), [&](std::size_t i) { return booth.seen(i); });
}

Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}

double of_linear(const std::string& illuminant, Eigen::Index bases) {
  const Booth booth(illuminant, 1);
  const Eigen::VectorXd light = vector(booth.light);
  Eigen::MatrixXd spectra(light.size(), 16);
  spectra.col(0) = light;
  for (std::size_t i = 0; i < 15; ++i)
    spectra.col(Eigen::Index(i) + 1) = light.cwiseProduct(vector(booth.surfaces[i]));
  const LinearBasis basis = make_basis(spectra, Eigen::VectorXd::Ones(light.size()), bases);
  return worst(booth, [&](std::size_t i) {
    const Eigen::VectorXd seen =
        basis.functions * basis.reflect(vector(booth.surfaces[i])) * basis.project(light);
    return to_xyz(booth.observer, {seen.data(), seen.data() + seen.size()});
  });
}

/// The naive way: each spectrum becomes linear sRGB, a surface by its colour under D65.
double of_rgb(const std::string& illuminant) {
  const Booth booth(illuminant, 1), daylight("D65", 1);
  const srgb::Rgb light = srgb::from_xyz(booth.white());
  return worst(booth, [&](std::size_t i) {
    srgb::Rgb seen = srgb::from_xyz(daylight.seen(i));
    for (std::size_t channel = 0; channel < 3; ++channel) seen[channel] *= light[channel];
    return srgb::to_xyz(seen);
  });
}

/// `value` is the figure as it is printed, to two digits or hundredths; two calculations may differ
/// by one in the last.
void expect_two_digits(double value, double printed, const std::string& what) {
  const double digit = std::max(0.01, std::pow(10, std::floor(std::log10(printed)) - 1));
  EXPECT_NEAR(value, printed, 1.01 * digit) << what;
}

struct Known {
  const char* illuminant;
  double uniform[4], linear[4], rgb;
};

const Known known[] = {
    {"A", {3.3, 0.53, 0.29, 0.09}, {20, 4.7, 2.3, 1.0}, 17},
    {"D65", {6.3, 1.2, 0.30, 0.11}, {8.4, 12, 2.4, 0.57}, 0.22},
    {"F2", {14, 3.3, 6.4, 0.18}, {7.2, 3.8, 2.3, 0.56}, 13},
    {"F11", {40, 28, 7.9, 0.33}, {1.9, 1.4, 1.8, 0.81}, 15},
};

TEST(KnownErrors, OfUniformSamples) {
  for (const Known& one : known) {
    const double steps[] = {50, 20, 10, 5};
    for (std::size_t i = 0; i < 4; ++i)
      expect_two_digits(of_uniform(one.illuminant, steps[i]), one.uniform[i],
                        std::string(one.illuminant) + " by " + std::to_string(steps[i]) + " nm");
  }
}

TEST(KnownErrors, OfTheLinearBasis) {
  for (const Known& one : known)
    for (Eigen::Index i = 0; i < 4; ++i)
      expect_two_digits(of_linear(one.illuminant, 3 + i), one.linear[i],
                        std::string(one.illuminant) + " with " + std::to_string(3 + i));
}

TEST(KnownErrors, OfNaiveRgb) {
  for (const Known& one : known)
    expect_two_digits(of_rgb(one.illuminant), one.rgb, std::string(one.illuminant) + " by rgb");
}

// Of fitted wavelengths the independent calculation gives a worst ΔE00 with eight, for direct light
// and over one more bounce.

TEST(KnownErrors, OfEightFittedWavelengths) {
  const std::pair<const char*, double> direct[] = {
      {"A", 0.6}, {"D65", 0.75}, {"F2", 1.4}, {"F11", 1.0}};
  for (const auto& [illuminant, known] : direct) {
    const test::MethodErrors errors = test::errors_of(illuminant, test::fitted(8));
    EXPECT_LT(errors.direct.worst, known) << illuminant;
    EXPECT_LT(errors.bounce.worst, 1.9) << illuminant;
  }
}

TEST(KnownErrors, EightFittedWavelengthsBeat31UniformUnderFluorescentLightAnd16Everywhere) {
  for (const char* illuminant : {"F2", "F11"}) {
    const test::MethodErrors fitted = test::errors_of(illuminant, test::fitted(8));
    const test::MethodErrors uniform = test::errors_of(illuminant, test::uniform(400, 700, 10));
    EXPECT_LT(4 * fitted.direct.worst, uniform.direct.worst) << illuminant;
    EXPECT_LT(4 * fitted.direct.mean, uniform.direct.mean) << illuminant;
    EXPECT_LT(2 * fitted.bounce.worst, uniform.bounce.worst) << illuminant;
  }
  for (const Known& one : known) {
    const test::MethodErrors fitted = test::errors_of(one.illuminant, test::fitted(8));
    const test::MethodErrors uniform = test::errors_of(one.illuminant, test::uniform(400, 700, 20));
    EXPECT_LT(fitted.direct.worst, uniform.direct.worst) << one.illuminant;
    EXPECT_LT(fitted.direct.mean, uniform.direct.mean) << one.illuminant;
    EXPECT_LT(fitted.bounce.worst, uniform.bounce.worst) << one.illuminant;
  }
}

}  // namespace
}  // namespace metamer
