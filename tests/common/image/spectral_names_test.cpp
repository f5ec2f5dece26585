// Names and units as the layout of Fichet, Pacanowski and Wilkie (2021) has them, and what others
// write.
#include "common/image/spectral_names.h"

#include <gtest/gtest.h>

#include "common/spectral/wavelengths.h"

namespace metamer {
namespace {

using Kind = SpectralChannel::Kind;

double nm_of(const std::string& name) {
  const auto channel = parse_spectral_channel(name);
  EXPECT_TRUE(channel) << name << ": " << (channel ? "" : channel.error().message);
  if (!channel || !*channel) return -1;
  return (*channel)->nm;
}

std::string refusal(const std::string& name) {
  const auto channel = parse_spectral_channel(name);
  return channel ? "none" : channel.error().message;
}

TEST(SpectralChannelName, IsWrittenWithACommaAndSixDecimals) {
  EXPECT_EQ(spectral_channel_name({Kind::emission, 550}), "S0.550,000000nm");
  EXPECT_EQ(spectral_channel_name({Kind::reflectance, 380.125}), "T.380,125000nm");
  EXPECT_EQ(nm_of("S0.550,000000nm"), 550);
  EXPECT_EQ(nm_of("T.380,125000nm"), 380.125);
}

TEST(SpectralChannelName, ComesInAnyLengthOrFrequency) {
  EXPECT_EQ(nm_of("S0.550.5nm"), 550.5);
  EXPECT_DOUBLE_EQ(nm_of("S0.0,55um"), 550);
  EXPECT_DOUBLE_EQ(nm_of("S0.0,55µm"), 550);
  EXPECT_DOUBLE_EQ(nm_of("S0.0,55\xCE\xBCm"), 550) << "the Greek letter";
  EXPECT_DOUBLE_EQ(nm_of("S0.5,5e-7m"), 550);
  EXPECT_DOUBLE_EQ(nm_of("S0.0,00055mm"), 550);
  // The candela's 540 THz, 555.17 nm (SI).
  EXPECT_NEAR(nm_of("S0.540THz"), 555.171, 1e-3);
  EXPECT_NEAR(nm_of("S0.5,4E14Hz"), 555.171, 1e-3);
}

TEST(SpectralChannelName, TellsEmissionReflectanceAndPolarisation) {
  const auto kind = [](const char* name) { return (*parse_spectral_channel(name))->kind; };
  EXPECT_EQ(kind("S0.550nm"), Kind::emission);
  EXPECT_EQ(kind("S3.550nm"), Kind::polarisation);
  EXPECT_EQ(kind("T.550nm"), Kind::reflectance);
}

TEST(SpectralChannelName, OfAnotherSortIsLeftAlone) {
  for (const char* name : {"R", "S0", "S4.550nm", "T.red", "Z", "", "left.S0.550nm", "S0.R"}) {
    const auto channel = parse_spectral_channel(name);
    ASSERT_TRUE(channel) << name;
    EXPECT_FALSE(*channel) << name;
  }
}

TEST(SpectralChannelName, ThatIsHostileIsRefused) {
  EXPECT_EQ(refusal("S0.,nm"), "channel \"S0.,nm\": \",nm\" is not a number and a unit");
  EXPECT_EQ(refusal("S0.nm"), "channel \"S0.nm\": \"nm\" is not a number and a unit");
  EXPECT_EQ(refusal("T.m"), "channel \"T.m\": \"m\" is not a number and a unit");
  EXPECT_EQ(refusal("T.5,5,0nm"), "channel \"T.5,5,0nm\": \"5,5,0nm\" is not a number and a unit");
  EXPECT_EQ(refusal("S0.550xm"), "channel \"S0.550xm\": \"550xm\" is not a number and a unit");
  const std::string range = " must be finite and above 0";
  for (const std::string number :
       {"1e400nm", "-550nm", "0nm", "0Hz", "-1THz", "nannm", "infnm", "1e-400nm", "1e300Ym"})
    EXPECT_EQ(refusal("S0." + number),
              "channel \"S0." + number + "\": the wavelength \"" + number + "\"" + range);
}

TEST(EmissiveUnits, HaveTwoSpellings) {
  EXPECT_EQ(emissive_units("W.m^-2.sr^-1"), "W.m^-2.sr^-1");
  EXPECT_EQ(emissive_units("W/m^2/sr"), "W.m^-2.sr^-1");
  EXPECT_EQ(emissive_units("W / m^2 / sr"), "W.m^-2.sr^-1");
  EXPECT_EQ(emissive_units("cd/m^2"), "cd/m^2");
}

}  // namespace
}  // namespace metamer
