#include "common/picture_head.h"

#include <gtest/gtest.h>

#include <fstream>

#include "exr_file.h"
#include "image_file.h"
#include "png_file.h"

namespace metamer {
namespace {

using PictureHead = ImageFile;

/// Of a file as libpng and OpenEXR have written it.
std::string slurped(const std::filesystem::path& file) {
  std::ifstream from(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(from), {}};
}
std::uint64_t values_in(const std::string& bytes) { return picture_values(bytes, bytes.size()); }

TEST_F(PictureHead, SaysHowManyValuesAPngHas) {
  const auto file = folder_ / "a.png";
  write_test_png(file, {.width = 30, .height = 2, .bytes = std::vector<unsigned char>(180)});
  EXPECT_EQ(values_in(slurped(file)), 30u * 2 * 4);
  write_test_png(file, {.width = 3,
                        .height = 5,
                        .color_type = PNG_COLOR_TYPE_GRAY_ALPHA,
                        .bits = 16,
                        .bytes = std::vector<unsigned char>(60)});
  EXPECT_EQ(values_in(slurped(file)), 3u * 5 * 4);
}

TEST_F(PictureHead, SaysHowManyValuesAnExrHas) {
  const auto file = folder_ / "a.exr";
  TestPart part{.channels = {{"B", 0}, {"G", 0}, {"R", 0}}, .display = {{-2, 3}, {7, 6}}};
  part.data = part.display;
  write_parts(file, {part});
  EXPECT_EQ(values_in(slurped(file)), 10u * 4 * 3);
  // The larger window counts, and the part that has most.
  part.data = {{0, 0}, {1, 1}};
  TestPart other{.name = "other", .channels = {{"Y", 0}}, .display = part.display};
  other.data = {{0, 0}, {19, 19}};
  part.name = "first";
  write_parts(file, {part, other});
  EXPECT_EQ(values_in(slurped(file)), 20u * 20);
  // Of many channels no more are read together.
  TestPart bands;
  for (int i = 0; i < 81; ++i) bands.channels.push_back({"S0." + std::to_string(i) + "nm", 0});
  write_parts(file, {bands});
  EXPECT_EQ(values_in(slurped(file)), 2u * 2 * 32);
}

TEST_F(PictureHead, IsBoundedWhateverTheFileSays) {
  const auto file = folder_ / "a.png";
  write_test_png(file, {.bytes = std::vector<unsigned char>(3)});
  std::string png = slurped(file);
  for (std::size_t i = 16; i < 24; ++i) png[i] = i % 4 == 0 ? '\x7f' : '\xff';  // 2³¹ − 1 squared
  EXPECT_EQ(values_in(png), png.size() * 1032 * 8 * 4) << "of deflate's most, in bits";
  EXPECT_EQ(picture_values(png, std::uint64_t{1} << 30), std::uint64_t{256} << 20);

  write_parts(folder_ / "a.exr", {{.channels = {{"Y", 0}}}});
  std::string exr = slurped(folder_ / "a.exr");
  const std::string box = "displayWindow";
  const std::size_t at = exr.find(box) + box.size() + 1 + 6 + 4;
  for (const std::size_t i : {std::size_t{8}, std::size_t{12}})
    exr.replace(at + i, 4, "\xff\xff\xff\x7f");
  EXPECT_EQ(values_in(exr), std::uint64_t{64} << 20);
}

TEST_F(PictureHead, OfNoPictureOrOneThatIsCutShortIsNone) {
  EXPECT_EQ(values_in(""), 0u);
  EXPECT_EQ(values_in("# proto-file: metamer/v1/scene.proto"), 0u);
  write_test_png(folder_ / "a.png", {.bytes = std::vector<unsigned char>(3)});
  write_parts(folder_ / "a.exr", {{.channels = {{"Y", 0}}}});
  for (const char* name : {"a.png", "a.exr"}) {
    const std::string whole = slurped(folder_ / name);
    EXPECT_TRUE(begins_picture(whole.substr(0, 8)));
    for (std::size_t length = 0; length < whole.size(); ++length)
      EXPECT_LE(values_in(whole.substr(0, length)), values_in(whole)) << name << length;
  }
}

}  // namespace
}  // namespace metamer
