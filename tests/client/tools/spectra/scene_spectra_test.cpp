// The spectra of a scene, and the words by which they are found again.
#include "client/tools/spectra/scene_spectra.h"

#include <gtest/gtest.h>

#include <fstream>

#include "client/tools/spectra/spectrum_word.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::client {
namespace {

TEST(WordedSpectra, EachWordMeansItsSpectrumAlone) {
  const TemporaryFolder folder;
  const std::string file = folder.file("lamps.csv");
  std::ofstream(file) << "um,warm,cold,warm\n0.4,1,2,3\n0.5,2,3,4\n0.6,3,1,5\n0.7,4,0,6\n";
  const auto all = worded_spectra(file + "@emission@um");
  ASSERT_TRUE(all) << all.error().problem.message;
  ASSERT_EQ(all->size(), 3u);
  for (const WordedSpectrum& one : *all) {
    const auto again = load_one(one.word);
    ASSERT_TRUE(again) << one.word;
    EXPECT_EQ(again->samples, one.spectrum.samples) << one.word;
    EXPECT_TRUE(again->emission());
    EXPECT_TRUE(one.spectrum.label.starts_with("lamps.csv: ")) << one.spectrum.label;
  }
  EXPECT_NE((*all)[0].spectrum.samples, (*all)[2].spectrum.samples);
  EXPECT_EQ(worded_spectra("D65")->front().word, "D65");
  EXPECT_FALSE(worded_spectra("D66"));
}

TEST(SceneSpectra, EachIsThereOnceWithItsOwnersAndItsWord) {
  const TemporaryFolder folder;
  folder.write("red paint.txt", "400 0.1\n500 0.1\n600 0.7\n700 0.8\n");
  v1::Scene scene;
  for (const char* name : {"left", "right"}) {
    v1::Light& light = *scene.add_light();
    light.set_name(name);
    light.mutable_spectrum()->set_standard("D65");
  }
  v1::Light& laser = *scene.add_light();
  laser.set_name("laser");
  v1::Line& line = *laser.mutable_spectrum()->add_line();
  line.set_nm(546.1);
  line.set_power(2);
  v1::Material& red = *scene.add_material();
  red.set_name("red");
  red.mutable_diffuse()->set_file("red paint.txt");
  red.mutable_diffuse()->set_interpolation(v1::Spectrum::LINEAR);
  red.mutable_diffuse()->mutable_reading()->set_clamp(true);
  red.mutable_specular()->set_constant(0.5);
  v1::Material& lost = *scene.add_material();
  lost.set_name("lost");
  lost.mutable_diffuse()->set_file("nowhere.txt");

  const SceneSpectra found = scene_spectra(scene, folder.file(""));
  ASSERT_EQ(found.spectra.size(), 4u);
  EXPECT_EQ(found.spectra[0].spectrum.label, "left, right");
  EXPECT_EQ(found.spectra[0].word, "D65");
  EXPECT_EQ(found.spectra[1].spectrum.label, "laser");
  EXPECT_EQ(found.spectra[1].word, "") << "lines are written in the scene";
  EXPECT_EQ(found.spectra[1].spectrum.samples.nm[1], 546.1);
  EXPECT_EQ(found.spectra[2].spectrum.label, "red");
  const auto again = load_one(found.spectra[2].word);
  ASSERT_TRUE(again) << found.spectra[2].word;
  EXPECT_EQ(again->samples, found.spectra[2].spectrum.samples);
  EXPECT_EQ(again->curve.interpolation, Interpolation::linear);
  EXPECT_EQ(found.spectra[3].spectrum.label, "red specular");
  ASSERT_EQ(found.problems.size(), 1u);
  EXPECT_EQ(found.problems[0].field, "material[1].diffuse");
}

}  // namespace
}  // namespace metamer::client
