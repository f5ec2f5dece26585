// The pictures of a file, each by the choice that means it.
#include "client/tools/pictures/picture_layers.h"

#include <gtest/gtest.h>

#include "common/image/read_xyz.h"

namespace metamer::client {
namespace {

std::filesystem::path exr_case(const char* name) {
  return std::filesystem::path(METAMER_TEST_DATA) / "common/image/cases" / name;
}

TEST(PictureLayers, EachCanBeRead) {
  const auto layers = picture_layers(exr_case("multipart.exr"));
  ASSERT_EQ(layers.size(), 2u);
  std::vector<std::string> read;
  for (const PictureLayer& one : layers) {
    const auto picture = read_xyz(exr_case("multipart.exr"), {}, one.choice);
    ASSERT_TRUE(picture) << one.name << ": " << format(picture.error());
    EXPECT_NE(picture->what.find(one.name), std::string::npos) << picture->what;
    read.push_back(picture->what);
  }
  EXPECT_NE(read[0], read[1]);
}

TEST(PictureLayers, AreNoneWhereThereIsOneOrNoFile) {
  EXPECT_TRUE(picture_layers(exr_case("rgb.exr")).empty());
  EXPECT_TRUE(picture_layers(exr_case("nothing.exr")).empty());
  EXPECT_TRUE(picture_layers("picture.png").empty());
}

}  // namespace
}  // namespace metamer::client
