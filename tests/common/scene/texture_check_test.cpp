#include <gtest/gtest.h>

#include "scene_text.h"

namespace metamer::test {
namespace {

Strings findings_of(const std::string& texture) {
  return findings({.material = "material { name: \"grey\" texture { " + texture + " } }"});
}
const std::string spectrum = " spectrum { constant: 0.5 } ";

TEST(TextureCheck, NeedsAPictureAndSpectra) {
  EXPECT_EQ(findings_of(spectrum), Strings({"material[0].texture: texture needs a file"}));
  EXPECT_EQ(findings_of("file: 'cloth.jpg'" + spectrum),
            Strings({"material[0].texture.file: file must end in .png or .exr (it is "
                     "\"cloth.jpg\")"}));
  EXPECT_EQ(findings_of("file: 'cloth.png'"),
            Strings({"material[0].texture.spectrum: a texture needs 1 to 32 spectra (it has 0)"}));
  EXPECT_EQ(findings_of("file: 'cloth.PNG'" + spectrum), Strings());
}

TEST(TextureCheck, ItsSpectraAreReflectances) {
  EXPECT_EQ(findings_of("file: 'cloth.png' spectrum { constant: 1.5 }"),
            Strings({"material[0].texture.spectrum[0].constant: a property must lie in 0..1 (it is "
                     "1.5)"}));
}

TEST(TextureCheck, ChannelsAndSpectraAgree) {
  EXPECT_EQ(findings_of("file: 'cloth.exr' channel: 'C' channel: 'M'" + spectrum),
            Strings({"material[0].texture.channel: there must be a channel for each spectrum, 1 "
                     "(there are 2)"}));
  EXPECT_EQ(findings_of("file: 'cloth.png' use: INDEX channel: ['R', 'G']" + spectrum + spectrum),
            Strings({"material[0].texture.channel: an INDEX needs 1 channel (there are 2)"}));
  EXPECT_EQ(findings_of("file: 'cloth.exr' use: INDEX" + spectrum),
            Strings({"material[0].texture.file: of an INDEX and an RGB it must be a .png (it is "
                     "\"cloth.exr\")"}));
}

TEST(TextureCheck, AnRgbHasNothingMeasured) {
  EXPECT_EQ(
      findings_of("file: 'cloth.png' use: RGB" + spectrum + " channel: 'R'"),
      Strings({"material[0].texture.spectrum: an RGB has colours and no spectra (there are 1)",
               "material[0].texture.channel: an RGB has its own channels, R, G and B"}));
  EXPECT_EQ(
      findings({.material = "material { name: \"grey\" diffuse { constant: 0.5 } "
                            "texture { file: 'cloth.png' use: RGB } }"}),
      Strings({"material[0].diffuse: an RGB texture leaves nothing of `diffuse` to be seen"}));
  EXPECT_EQ(findings({.material = "material { name: \"grey\" fluorescence { file: 'uv.csv' } "
                                  "texture { file: 'cloth.png' use: RGB } }"}),
            Strings({"material[0].fluorescence: an RGB texture leaves nothing of the surface that "
                     "fluoresces to be seen"}));
}

TEST(TextureCheck, AScaleIsNoZero) {
  EXPECT_EQ(findings_of("file: 'cloth.png' scale { u: 2 }" + spectrum),
            Strings({"material[0].texture.scale.v: v must not be 0"}));
}

Strings map_findings(const std::string& maps) {
  return findings({.material = "material { name: \"grey\" " + maps + " }"});
}

TEST(TextureCheck, AMapNeedsAPictureThatLiesSomewhere) {
  EXPECT_EQ(map_findings("normal_map {} bump_map { file: 'h.jpg' } alpha { file: 'a.png' scale { "
                         "v: 1 } }"),
            Strings({"material[0].normal_map: map needs a file",
                     "material[0].bump_map.file: file must end in .png or .exr (it is \"h.jpg\")",
                     "material[0].alpha.scale.u: u must not be 0"}));
  EXPECT_EQ(map_findings("normal_map { file: 'n.png' strength: -2 } bump_map { file: 'h.exr' "
                         "channel: 'Y' } alpha { file: 'a.png' channel: 'A' cutoff: 0.5 }"),
            Strings());
}

TEST(TextureCheck, AMapHasWhatItsUseHas) {
  EXPECT_EQ(
      map_findings("normal_map { file: 'n.png' channel: 'R' cutoff: 0.5 strength: 1e7 } "
                   "alpha { file: 'a.png' strength: 1 cutoff: 1.5 }"),
      Strings({"material[0].normal_map.channel: a normal map has its own channels, R, G and B",
               "material[0].normal_map.cutoff: only an alpha has one",
               "material[0].normal_map.strength: strength must lie in -1e+06..1e+06 (it is 1e+07)",
               "material[0].alpha.strength: an alpha has none: `cutoff` makes it hard",
               "material[0].alpha.cutoff: cutoff must lie in 0..1 (it is 1.5)"}));
}

TEST(TextureCheck, WhatEnclosesAVolumeHasNoHoles) {
  EXPECT_EQ(
      map_findings("fresnel { dielectric { medium: \"N-BK7\" } } transmission {} alpha { file: "
                   "'a.png' }"),
      Strings({"material[0].alpha: what lets light through encloses a volume: its surface "
               "has no holes"}));
}

}  // namespace
}  // namespace metamer::test
