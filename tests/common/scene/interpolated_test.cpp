// What a scene's data are between their samples, and its lines.
#include "common/scene/interpolated.h"

#include <gtest/gtest.h>

#include "common/scene/limits.h"
#include "common/scene/scene_file.h"
#include "common/spectral/cie.h"
#include "common/spectral/lines.h"
#include "scene_text.h"

namespace metamer::test {
namespace {

const char* const even_paint =
    "samples { wavelength: [400, 420, 440, 460, 480, 500] value: [0.1, 0.2, 0.8, 0.7, 0.3, 0.2] }";
const char* const uneven_paint =
    "samples { wavelength: [400, 420, 440, 461, 480, 500] value: [0.1, 0.2, 0.8, 0.7, 0.3, 0.2] }";

Strings findings_of_light(const std::string& spectrum) {
  return findings({.light = "light { position { } spectrum { " + spectrum + " } }"});
}

Strings findings_of_diffuse(const std::string& spectrum) {
  return findings({.material = "material { name: \"grey\" diffuse { " + spectrum + " } }"});
}

/// The spectrum of this text, which is sound, with this file beside it.
Spectrum loaded(const std::string& text, SpectrumRole role, const std::string& file = {}) {
  const auto scene = SceneFile::parse("light { spectrum { " + text + " } }", "s.txtpb");
  const auto read = [&](const std::string&) -> Result<std::string> { return file; };
  const auto spectrum = load_spectrum(scene.value().scene().light(0).spectrum(), "m", role, read);
  EXPECT_TRUE(spectrum) << spectrum.error().message;
  return spectrum.value_or(Spectrum{{1}, {0}});
}

Spectrum curve(const Spectrum& samples, Interpolation interpolation, ValueRange range) {
  return interpolated(samples, interpolation, range, observer_wavelengths().nm())->spectrum;
}

TEST(SceneInterpolation, IsTheRecommendedOneWhereNobodySays) {
  const Spectrum even{{400, 420, 440, 460, 480, 500}, {0.1, 0.2, 0.8, 0.7, 0.3, 0.2}};
  const Spectrum uneven{{400, 420, 440, 461, 480, 500}, {0.1, 0.2, 0.8, 0.7, 0.3, 0.2}};
  EXPECT_EQ(loaded(even_paint, SpectrumRole::property),
            curve(even, Interpolation::sprague, {0, 1}));
  EXPECT_EQ(loaded(uneven_paint, SpectrumRole::property),
            curve(uneven, Interpolation::monotone_cubic, {0, 1}));
  EXPECT_EQ(loaded("file: \"paint.txt\"", SpectrumRole::property,
                   "400 500 20\n0.1\n0.2\n0.8\n0.7\n0.3\n0.2\n"),
            curve(even, Interpolation::sprague, {0, 1}));
  // A light of such steps has a line at 440 nm.
  EXPECT_EQ(loaded(even_paint, SpectrumRole::emission), even);
  for (const SpectrumRole role :
       {SpectrumRole::reflectance, SpectrumRole::index, SpectrumRole::extinction})
    EXPECT_EQ(loaded(even_paint, role), even);
}

TEST(SceneInterpolation, IsTheOneThatIsAskedFor) {
  const Spectrum even{{400, 420, 440, 460, 480, 500}, {0.1, 0.2, 0.8, 0.7, 0.3, 0.2}};
  const std::string text = even_paint;
  EXPECT_EQ(loaded(text + " interpolation: LINEAR", SpectrumRole::property), even);
  EXPECT_EQ(loaded(text + " interpolation: MONOTONE_CUBIC", SpectrumRole::property),
            curve(even, Interpolation::monotone_cubic, {0, 1}));
  EXPECT_EQ(loaded(text + " interpolation: SPRAGUE", SpectrumRole::emission),
            curve(even, Interpolation::sprague, value_range(SpectrumRole::emission)));
  EXPECT_EQ(loaded(text + " interpolation: SPRAGUE", SpectrumRole::index),
            curve(even, Interpolation::sprague, {0.01, 100}));
}

TEST(SceneInterpolation, OfStandardIlluminantsIsTheCies) {
  // CIE 15: straight lines, whatever their tables' steps.
  for (const std::string& name : cie::illuminant_names())
    EXPECT_EQ(loaded("standard: \"" + name + "\"", SpectrumRole::emission), *cie::illuminant(name));
}

TEST(SceneInterpolation, IsRefusedWithItsPlace) {
  EXPECT_EQ(findings_of_diffuse(std::string(uneven_paint) + " interpolation: SPRAGUE"),
            Strings({"material[0].diffuse.interpolation: Sprague's interpolation takes samples at "
                     "even distances; 461 nm is not at one"}));
  EXPECT_EQ(findings_of_diffuse("samples { wavelength: [400, 500] value: [0.1, 0.2] } "
                                "interpolation: MONOTONE_CUBIC"),
            Strings({"material[0].diffuse.interpolation: a monotone cubic takes 3 samples at "
                     "least, not 2"}));
  EXPECT_EQ(findings_of_light("standard: \"D65\" interpolation: LINEAR"),
            Strings({"light[0].spectrum.interpolation: interpolation is for spectra from a file "
                     "or from samples"}));

  // Files are seen when they are read, by both ways of reading them.
  v1::Scene scene;
  v1::Spectrum& diffuse = *scene.add_material()->mutable_diffuse();
  diffuse.set_file("paint.txt");
  diffuse.set_interpolation(v1::Spectrum::SPRAGUE);
  const auto read = [](const std::string&) -> Result<std::string> { return "400 0.1\n500 0.2\n"; };
  const Strings refusal = {
      "material[0].diffuse.interpolation: Sprague's interpolation takes 6 samples at least, not 2"};
  EXPECT_EQ(describe(validate_spectra(scene, read)), refusal);
  const auto alone = load_spectrum(diffuse, "material[0].diffuse", SpectrumRole::property, read);
  EXPECT_EQ(describe({alone.error()}), refusal);
}

TEST(SceneLines, AddToTheSource) {
  const std::string mercury = "line { nm: 546.1 power: 2 } line { nm: 435.8 power: 1 } ";
  const std::vector<Line> lines = {{546.1, 2}, {435.8, 1}};
  EXPECT_EQ(loaded(mercury, SpectrumRole::emission), with_lines({}, lines));
  EXPECT_EQ(loaded(mercury + "standard: \"F11\"", SpectrumRole::emission),
            with_lines(*cie::illuminant("F11"), lines));
  // A source of one sample is a line as well.
  EXPECT_EQ(loaded(mercury + "samples { wavelength: 500 value: 3 }", SpectrumRole::emission),
            with_lines(as_emission({{500}, {3}}), lines));
  // The continuum is judged by itself, and is curved.
  const Spectrum glow{{400, 420, 440, 460, 480, 500}, {1, 1.1, 1.15, 1.15, 1.1, 1}};
  EXPECT_EQ(loaded(mercury + "samples { wavelength: [400, 420, 440, 460, 480, 500] value: [1, 1.1, "
                             "1.15, 1.15, 1.1, 1] }",
                   SpectrumRole::emission),
            with_lines(curve(glow, Interpolation::sprague, {0, 2}), lines));
}

TEST(SceneLines, AreRefusedWithTheirPlace) {
  EXPECT_EQ(findings_of_diffuse("constant: 0.5 line { nm: 500 power: 1 }"),
            Strings({"material[0].diffuse.line: lines are for emissions"}));
  EXPECT_EQ(
      findings_of_diffuse("line { nm: 500 power: 1 }"),
      Strings({"material[0].diffuse: spectrum needs a standard, a file, a constant or samples",
               "material[0].diffuse.line: lines are for emissions"}));
  EXPECT_EQ(findings_of_light("line { nm: 500 power: 1 } line { nm: 0.5 power: -2 }"),
            Strings({"light[0].spectrum.line[1].nm: nm must lie in 1..10000 (it is 0.5)",
                     "light[0].spectrum.line[1].power: power must be above 0 (it is -2)"}));
  EXPECT_EQ(findings_of_light("line { nm: nan power: 1 }"),
            Strings({"light[0].spectrum.line[0].nm: nm must be finite (it is nan)"}));
  std::string many;
  for (int i = 0; i <= limits::max_lines; ++i) many += "line { nm: 500 power: 1 } ";
  EXPECT_EQ(findings_of_light(many), Strings({"light[0].spectrum.line: at most 256 lines are "
                                              "possible (there are 257)"}));
}

}  // namespace
}  // namespace metamer::test
