// What a viewer that goes by a picture's profile shows of D65's grey. LittleCMS judges: its
// transicc (Debian's package liblcms2-utils).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "client/tools/pictures/planned_developing.h"
#include "common/color/lab.h"
#include "common/color/srgb.h"
#include "common/image/icc.h"
#include "common/image/read_xyz.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::client {
namespace {

v1::Plan plan_for(v1::RgbSpace space, std::optional<v1::Adaptation> adaptation) {
  v1::Plan plan;
  plan.mutable_development()->set_rgb_space(space);
  if (adaptation) plan.mutable_development()->set_adaptation(*adaptation);
  return plan;
}

/// The first pixel's codes, 0 to 255.
std::vector<long> codes_of(const std::string& file) {
  const auto image = read_image(file);
  std::vector<long> codes;
  for (std::size_t c = 0; c < 3; ++c) codes.push_back(std::lround(255 * image->pixels[c]));
  return codes;
}

/// sRGB of codes in a profile, relative colorimetric, by LittleCMS.
Rgb shown_by_littlecms(const std::string& folder, const std::vector<long>& codes) {
  std::ofstream(folder + "/codes") << codes[0] << ' ' << codes[1] << ' ' << codes[2] << '\n';
  const std::string command =
      "cd '" + folder + "' && transicc -n -t1 -i space.icc -o '*sRGB' < codes > shown 2> said";
  EXPECT_EQ(std::system(command.c_str()), 0) << "Debian's package liblcms2-utils";
  std::ifstream stream(folder + "/shown");
  std::stringstream text;
  text << stream.rdbuf();
  Rgb encoded{};
  EXPECT_EQ(std::sscanf(text.str().c_str(), "%lf %lf %lf", &encoded[0], &encoded[1], &encoded[2]),
            3)
      << text.str();
  Rgb linear{};
  for (std::size_t c = 0; c < 3; ++c) linear[c] = decode(srgb::space().transfer, encoded[c] / 255);
  return linear;
}

/// Y of the grey: a whole code in a linear space, as its 8 bits shall not tint it.
constexpr double level = 153. / 255;

/// ΔE00 of the grey and what is shown of it.
double off(const TemporaryFolder& folder, const v1::Plan& plan) {
  const auto planned = planned_developing(plan);
  EXPECT_TRUE(planned);
  const Xyz white = srgb::to_xyz({1, 1, 1});
  Image grey = make_image(1, 1, {"X", "Y", "Z"});
  for (std::size_t c = 0; c < 3; ++c) grey.pixels[c] = static_cast<float>(level * white[c]);
  const std::string png = folder.file("grey.png");
  EXPECT_TRUE(write_image(grey, png, false, {}, planned->developing));
  std::ofstream(folder.file("space.icc"), std::ios::binary)
      << icc_profile(planned->developing.space, false);
  const Rgb shown = shown_by_littlecms(folder.file("."), codes_of(png));
  return delta_e_00(to_lab(srgb::to_xyz(shown), white),
                    to_lab({level * white[0], level * white[1], level * white[2]}, white));
}

constexpr v1::RgbSpace spaces[] = {v1::SRGB,     v1::DISPLAY_P3, v1::ADOBE_RGB,
                                   v1::PROPHOTO, v1::REC_2020,   v1::CIE_RGB};

TEST(ShownWhite, OfD65IsGreyInEverySpace) {
  const TemporaryFolder folder;
  for (const v1::RgbSpace space : spaces)
    EXPECT_LT(off(folder, plan_for(space, {})), 0.5) << v1::RgbSpace_Name(space);
}

TEST(ShownWhite, IsTintedWithoutAdaptationAndSaysSo) {
  const TemporaryFolder folder;
  for (const v1::RgbSpace space : spaces) {
    const v1::Plan plan = plan_for(space, v1::NO_ADAPTATION);
    const bool other = space == v1::PROPHOTO || space == v1::CIE_RGB;
    EXPECT_EQ(planned_developing(plan)->shown_white.empty(), !other);
    EXPECT_EQ(planned_developing(plan_for(space, {}))->shown_white.empty(), !other);
    EXPECT_EQ(planned_developing(plan)->developing.adaptation, identity3);
    if (!other) continue;
    EXPECT_GT(off(folder, plan), 5) << v1::RgbSpace_Name(space);
  }
  EXPECT_EQ(planned_developing(plan_for(v1::PROPHOTO, v1::NO_ADAPTATION))->shown_white,
            "not adapted: a viewer that goes by the white of ProPhoto RGB shows D65's grey tinted");
}

TEST(ShownWhite, ComesBackFromItsFileAsItIsSeen) {
  const TemporaryFolder folder;
  Image picture = make_image(1, 1, {"X", "Y", "Z"});
  picture.pixels = {0.3F, 0.32F, 0.25F};
  for (const v1::RgbSpace space : spaces)
    for (const char* name : {"a.png", "a.exr"}) {
      const auto planned = planned_developing(plan_for(space, {}));
      ASSERT_TRUE(write_image(picture, folder.file(name), false, {}, planned->developing));
      const auto read = read_xyz(folder.file(name), {});
      ASSERT_TRUE(read);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(read->image.pixels[c], picture.pixels[c], name[2] == 'e' ? 1e-5 : 4e-3)
            << v1::RgbSpace_Name(space) << " " << name;
    }
}

}  // namespace
}  // namespace metamer::client
