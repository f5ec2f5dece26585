#include "common/color/chain_bands.h"

#include <gtest/gtest.h>

#include "common/spectral/cie.h"
#include "common/spectral/optical_constants.h"

namespace metamer {
namespace {

SeenLight seen(const Spectrum& emission, const Spectrum& surface) {
  return {cie::observer_1931(), emission, surface.nm};
}

TEST(ChainBands, WithoutMirrorsAreTwoAnAxis) {
  const Spectrum grey{{550}, {0.5}};
  const std::vector<SeenLight> lights{seen(*cie::illuminant("F11"), grey)};
  const ChainBands bands({grey}, 16, {&grey}, lights);
  EXPECT_EQ(bands.nm.size(), 6u);
  EXPECT_EQ(bands.edges, (std::vector<double>{360, 830}));
}

TEST(ChainBands, SensorsOfASurfaceSumToItsColour) {
  const Spectrum paint{{400, 447.3, 500, 560, 600, 700}, {0.1, 0.7, 0.6, 0.2, 0.8, 0.3}};
  const Spectrum mirror{{400, 520, 700}, {0.2, 0.5, 0.9}};
  for (const char* name : {"D65", "A", "F11"}) {
    const Spectrum& light = *cie::illuminant(name);
    const std::vector<SeenLight> lights{seen(light, paint)};
    const ChainBands bands({mirror}, 4, {&paint}, lights);
    std::vector<float> at_edges;
    for (const double value : resample(paint, bands.edges, Outside::hold).values)
      at_edges.push_back(static_cast<float>(value));
    const std::vector<double> sensors = SurfaceSensors(lights[0], bands).of(at_edges);
    const Xyz expected = to_xyz(under_light(cie::observer_1931(), light, paint.nm), paint.values);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (std::size_t i = bands.first[axis]; i < bands.first[axis + 1]; ++i) sum += sensors[i];
      EXPECT_NEAR(sum, expected[axis], 2e-6) << name;
    }
  }
}

// Smooth data by 1 nm, as measured data by 10 nm becomes: straight lines that hardly bend.
TEST(ChainBands, EdgesAreWhereSpectraBendAndNotWhereTheyHaveSamples) {
  Spectrum smooth, kinked;
  for (int nm = 380; nm <= 780; ++nm) {
    smooth.nm.push_back(nm);
    smooth.values.push_back(0.4 + 0.2 * std::sin(nm / 40.0));
    kinked.nm.push_back(nm);
    kinked.values.push_back(nm < 500 ? 0.2 : 0.2 + (nm - 500) / 1000.0);
  }
  const std::vector<SeenLight> lights{seen(*cie::illuminant("D65"), smooth)};
  EXPECT_LT(bend_edges({&smooth}, lights).size(), smooth.nm.size() * 2 / 3);
  EXPECT_LT(bend_edges({&kinked}, lights).size(), 6u);
}

}  // namespace
}  // namespace metamer
