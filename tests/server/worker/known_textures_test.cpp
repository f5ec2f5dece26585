#include "server/worker/known_textures.h"

#include <gtest/gtest.h>

namespace metamer::worker {
namespace {

v1::Texture texture(const std::string& file) {
  v1::Texture message;
  message.set_file(file);
  message.add_spectrum()->set_constant(0.5);
  return message;
}

/// Reads of a picture are counted; the one that is read has one weight.
struct KnownTexturesTest : testing::Test {
  int reads = 0;
  AssetNames names;
  KnownTextures known;

  KnownTexturesTest() { name("a.png", "1"); }

  void name(const std::string& file, const std::string& digest) {
    v1::AssetName& asset = *names.Add();
    asset.set_name(file);
    asset.set_sha256(digest);
  }
  void ask(const v1::Texture& message, PictureUse use = PictureUse::texture) {
    const TextureImport import = known.reusing(
        [&](const v1::Texture&, PictureUse, const std::string&) -> Result<TexturePicture> {
          ++reads;
          return with_levels(1, 1, 1, {7});
        },
        names);
    const auto picture = import(message, use, "material[0].texture");
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->weights[0], 7);
  }
};

TEST_F(KnownTexturesTest, APictureIsReadOnceWhateverItsSpectraAndPlaceAre) {
  ask(texture("a.png"));
  v1::Texture moved = texture("a.png");
  moved.mutable_offset()->set_u(0.5);
  moved.mutable_spectrum(0)->set_constant(0.25);
  ask(moved);
  EXPECT_EQ(reads, 1);
}

TEST_F(KnownTexturesTest, OtherBytesOfTheSameNameAreReadAnew) {
  ask(texture("a.png"));
  names.Clear();
  name("a.png", "2");
  ask(texture("a.png"));
  EXPECT_EQ(reads, 2);
}

TEST_F(KnownTexturesTest, AnotherUseOrNumberOfSpectraIsReadAnew) {
  ask(texture("a.png"));
  v1::Texture index = texture("a.png");
  index.set_use(v1::Texture::INDEX);
  ask(index);
  index.add_spectrum()->set_constant(0.1);
  ask(index);
  EXPECT_EQ(reads, 3);
}

TEST_F(KnownTexturesTest, WhatIsReadAsAlphaIsReadAnewAsHeights) {
  ask(texture("a.png"), PictureUse::alpha);
  ask(texture("a.png"), PictureUse::heights);
  ask(texture("a.png"), PictureUse::alpha);
  EXPECT_EQ(reads, 2);
}

TEST_F(KnownTexturesTest, WhatNobodyAskedForIsForgotten) {
  ask(texture("a.png"));
  known = std::move(known).asked();
  known = std::move(known).asked();  // nobody asked since
  ask(texture("a.png"));
  EXPECT_EQ(reads, 2);
}

}  // namespace
}  // namespace metamer::worker
