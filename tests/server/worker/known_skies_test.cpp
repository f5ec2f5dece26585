#include "server/worker/known_skies.h"

#include <gtest/gtest.h>

namespace metamer::worker {
namespace {

TEST(KnownSkies, AreReadOnceUntilTheirBytesAreOthersOrNobodyAsks) {
  int reads = 0;
  AssetNames names;
  v1::AssetName& asset = *names.Add();
  asset.set_name("a.exr");
  asset.set_sha256("1");
  KnownSkies known;
  const auto ask = [&] {
    const SkyImport import = known.reusing(
        [&](const std::string&) -> Result<std::shared_ptr<const ReadSky>> {
          ++reads;
          return std::make_shared<const ReadSky>();
        },
        names);
    return *import("a.exr");
  };
  EXPECT_EQ(ask(), ask());
  EXPECT_EQ(reads, 1);
  asset.set_sha256("2");
  ask();
  EXPECT_EQ(reads, 2);
  known = std::move(known).asked();
  ask();
  EXPECT_EQ(reads, 2);
  known = std::move(std::move(known).asked()).asked();  // nobody asked since
  ask();
  EXPECT_EQ(reads, 3);
}

}  // namespace
}  // namespace metamer::worker
