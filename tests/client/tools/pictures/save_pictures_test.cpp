// A finished picture into files, read back.
#include "client/tools/pictures/save_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/image/read_xyz.h"
#include "common/image/spectral_exr.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::client {
namespace {

/// Three pixels: a grey, a colour that sRGB does not hold, and twice its white.
Image three_pixels() {
  Image image = make_image(3, 1, {"X", "Y", "Z"});
  const float values[] = {0.2f, 0.2f, 0.2f, 0, 0.3f, 0, 1.9f, 2, 2.18f};
  std::copy(std::begin(values), std::end(values), image.pixels.begin());
  return image;
}

v1::Plan plan_of_srgb() {
  v1::Plan plan;
  for (const double value : {0.9505, 1., 1.089}) plan.add_source_white(value);
  return plan;
}

Result<SavedPicture> saved_as(const std::string& file, const ExrContent& exr) {
  const Image image = three_pixels();
  const v1::Plan plan = plan_of_srgb();
  return save_picture({image, plan, nullptr, nullptr, {}}, file, exr, *planned_developing(plan));
}

/// One pixel: a light of three samples on white, weight 0.5.
struct KeptPixel {
  KeptPixel() {
    v1::SceneFactors::Light& light = *scene.add_light();
    light.set_name("lamp");
    light.set_luminance(1);
    for (const double nm : {400., 550., 700.}) light.mutable_power()->add_nm(nm);
    for (const double value : {1., 3., 1.}) light.mutable_power()->add_values(value);
    factors.scene = scene;
    factors.width = factors.height = 1;
    factors.end = {1};
    factors.signature = {0};
    factors.weight = {0.5f};
    factors.tables.add_signature_product(0);
    factors.tables.add_signature_light(0);
    factors.tables.add_signature_material(0);
    factors.tables.add_signature_term(v1::FACTOR_WHITE);
    factors.tables.add_signature_node(0);
  }
  Result<SavedPicture> save(const std::string& file, const Wavelengths& wavelengths) {
    const v1::Plan plan = plan_of_srgb();
    const Image xyz = make_image(1, 1, {"X", "Y", "Z"});
    return save_picture({xyz, plan, &factors, &scene, {}}, file,
                        {.xyz = false, .spectral = wavelengths}, *planned_developing(plan));
  }
  v1::SceneFactors scene;
  Factors factors;
};

TEST(SavePictures, APngCountsWhatItClips) {
  const TemporaryFolder folder;
  const auto saved = saved_as(folder.file("a.png"), {});
  ASSERT_TRUE(saved);
  EXPECT_EQ(saved->clipped.negative, 1u);
  EXPECT_EQ(saved->clipped.above, 1u);
  EXPECT_FALSE(saved->spectral);
}

TEST(SavePictures, AnExrOfXyzIsThePictureBitForBit) {
  const TemporaryFolder folder;
  const std::string file = folder.file("A.EXR");
  const auto saved = saved_as(file, {.xyz = true});
  ASSERT_TRUE(saved);
  EXPECT_EQ(saved->clipped.negative + saved->clipped.above, 0u) << "nothing is clipped";
  EXPECT_EQ(read_xyz(file, {})->image.pixels, three_pixels().pixels);
}

TEST(SavePictures, AnExrOfRgbKeepsWhatIsOutsideTheSpace) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  ASSERT_TRUE(saved_as(file, {}));
  const Image read = read_xyz(file, {})->image;
  for (std::size_t i = 0; i < read.pixels.size(); ++i)
    EXPECT_NEAR(read.pixels[i], three_pixels().pixels[i], 2e-6);
}

TEST(SavePictures, SpectraAreTheLightTimesTheWeight) {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  KeptPixel pixel;
  const auto saved = pixel.save(file, *Wavelengths::uniform(400, 700, 5));
  ASSERT_TRUE(saved);
  EXPECT_TRUE(saved->spectral);
  EXPECT_TRUE(saved->mis_seen.empty());
  const auto read = read_spectral_exr(file);
  ASSERT_TRUE(read && *read);
  const std::vector<float>& values = (*read)->values;
  ASSERT_EQ(values.size(), 61u);
  // Means over hats of 5 nm to either side, of a light that rises by 2 over 150 nm: a third of 5 nm
  // away from the end and from the peak, on average.
  const double third = 2. / 150 * 5 / 3;
  EXPECT_NEAR(values[30] / values[0], (3 - third) / (1 + third), 1e-6);
  EXPECT_NEAR(values[15] / values[0], 2 / (1 + third), 1e-6);
}

TEST(SavePictures, SaysOfWhichLightTooLittleIsSeen) {
  const TemporaryFolder folder;
  KeptPixel pixel;
  const auto saved = pixel.save(folder.file("a.exr"), *Wavelengths::uniform(600, 700, 5));
  ASSERT_TRUE(saved);
  ASSERT_EQ(saved->mis_seen.size(), 1u);
  EXPECT_EQ(saved->mis_seen[0].light, "lamp");
  EXPECT_LT(saved->mis_seen[0].share, 0.5);
}

TEST(SavePictures, NamesTheFileThatCanNotBeWritten) {
  const TemporaryFolder folder;
  for (const char* name : {"none/a.png", "none/a.exr", "a.jpeg"}) {
    const auto saved = saved_as(folder.file(name), {});
    ASSERT_FALSE(saved) << name;
    EXPECT_EQ(saved.error().file, folder.file(name));
  }
}

TEST(SavePictures, ObjectsToAFileBeforeThereIsAPicture) {
  const TemporaryFolder folder;
  EXPECT_EQ(objection(folder.file("a.png"), FileContent::picture), "");
  EXPECT_EQ(objection(folder.file("a.ExR"), FileContent::picture), "");
  EXPECT_EQ(objection(folder.file("a.factors"), FileContent::factors), "");
  EXPECT_EQ(objection("a.factors", FileContent::picture),
            "\"a.factors\" ends neither in .png nor in .exr");
  EXPECT_EQ(objection("a.png", FileContent::factors), "\"a.png\" does not end in .factors");
  EXPECT_EQ(objection("", FileContent::picture), "\"\" ends neither in .png nor in .exr");
  std::filesystem::create_directory(folder.file("folder.png"));
  EXPECT_EQ(objection(folder.file("folder.png"), FileContent::picture),
            "\"" + folder.file("folder.png") + "\" is a folder");
  EXPECT_EQ(objection(folder.file("none/a.png"), FileContent::picture),
            "there is no folder \"" + folder.file("none") + "\"");
}

}  // namespace
}  // namespace metamer::client
