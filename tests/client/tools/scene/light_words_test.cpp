// Spectra by words, as a scene has them without a file.
#include "client/tools/scene/light_words.h"

#include <gtest/gtest.h>

#include "common/spectral/cie.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::client {
namespace {

/// The curve that a scene makes of it.
Result<Spectrum> embedded_curve(const std::string& word, SpectrumRole role,
                                const std::filesystem::path& folder = {}) {
  const auto no_file = [](const std::string& name) -> Result<std::string> {
    return problem("no file " + name);
  };
  return embedded_spectrum(word, role, folder).and_then([&](const v1::Spectrum& message) {
    return load_spectrum(message, {}, role, no_file);
  });
}

TEST(EmbeddedSpectrum, OfAnIlluminantIsItsName) {
  for (const char* name : {"D65", "F11", "2856K", "436nm:0.6+546.1nm"}) {
    const auto light = embedded_spectrum(name, SpectrumRole::emission);
    ASSERT_TRUE(light) << light.error().message;
    EXPECT_EQ(light->standard(), name);
  }
}

TEST(EmbeddedSpectrum, OfATestColourIsTheCiesTable) {
  const auto paint = embedded_curve("TCS09", SpectrumRole::property);
  ASSERT_TRUE(paint);
  EXPECT_EQ(*paint, *cie::test_color("TCS09"));
}

TEST(EmbeddedSpectrum, OfAFileIsTheCurveThatASceneMakesOfTheFile) {
  const TemporaryFolder folder;
  const std::string text = "400 0.1\n450 0.12\n500 0.4\n550 0.7\n600 0.5\n650 0.3\n700 0.2\n";
  folder.write("paint.txt", text);
  const auto embedded = embedded_curve("paint.txt", SpectrumRole::property, folder.file({}));
  ASSERT_TRUE(embedded) << embedded.error().message;
  v1::Spectrum named;
  named.set_file("paint.txt");
  const auto from_file =
      load_spectrum(named, {}, SpectrumRole::property,
                    [&](const std::string&) -> Result<std::string> { return text; });
  ASSERT_TRUE(from_file);
  EXPECT_EQ(*embedded, *from_file);
}

TEST(EmbeddedSpectrum, WhatIsNoneOfItsRoleIsRefused) {
  EXPECT_FALSE(embedded_spectrum("TCS09", SpectrumRole::emission));
  EXPECT_FALSE(embedded_spectrum("D65", SpectrumRole::property));
  EXPECT_FALSE(embedded_spectrum("F13", SpectrumRole::emission));
  EXPECT_FALSE(embedded_spectrum("", SpectrumRole::emission));
  const TemporaryFolder folder;
  folder.write("dark.txt", "400 -1\n700 -2\n");
  EXPECT_FALSE(embedded_spectrum("dark.txt", SpectrumRole::emission, folder.file({})));
}

TEST(EmbeddedSpectrum, WhatAWordIsIsKnownWhereNobodySays) {
  EXPECT_EQ(role_of_word("TCS01"), SpectrumRole::property);
  EXPECT_EQ(role_of_word("A"), SpectrumRole::emission);
  const TemporaryFolder folder;
  folder.write("lamp.txt", "400 10\n550 80\n700 40\n");
  EXPECT_EQ(role_of_word("lamp.txt", folder.file({})), SpectrumRole::emission);
  EXPECT_FALSE(role_of_word("nowhere.txt", folder.file({})));
}

}  // namespace
}  // namespace metamer::client
