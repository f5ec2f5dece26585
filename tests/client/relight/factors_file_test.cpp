// A picture's factors from tiles and in files, sound and damaged.

#include "client/relight/factors.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "client/relight/relight.h"
#include "client/relight/signature_colors.h"
#include "common/scene/fresnel_table.h"
#include "tests/client/relight/some_factors.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

TEST(FactorsBuilder, PutsTilesTogetherWhoseTablesDiffer) {
  // The same pixels, one a tile, the right one first and its tables in another order.
  v1::TileFactors left = tile_factors(), right = tile_factors();
  left.mutable_count()->Truncate(1);
  left.mutable_signature()->Truncate(1);
  left.mutable_weight()->Truncate(1);
  right.clear_count();
  right.clear_signature();
  right.clear_weight();
  right.add_count(2);
  right.mutable_signature_product()->SwapElements(0, 2);
  right.mutable_signature_term()->SwapElements(0, 2);
  for (const std::uint32_t signature : {1u, 0u}) right.add_signature(signature);
  for (const float weight : {2.0f, 0.125f}) right.add_weight(weight);
  v1::Tile left_tile = tile(left), right_tile = tile(right);
  left_tile.set_width(1);
  right_tile.set_width(1);
  right_tile.set_x(1);

  auto builder = FactorsBuilder::make(plan(), scene());
  ASSERT_TRUE(builder->add(right_tile));
  ASSERT_TRUE(builder->add(left_tile));
  const Factors factors = builder->finish();
  EXPECT_EQ(factors.tables.product_parent_size(), 1);
  EXPECT_EQ(factors.tables.signature_product_size(), 3);
  const auto& observer = cie::observer_1931();
  EXPECT_EQ(relight(factors, scene(), observer).pixels, relight(build(), scene(), observer).pixels);
}

struct Damage {
  const char* name;
  std::function<void(v1::TileFactors&)> damage;
  const char* message;
};

class DamagedTile : public testing::TestWithParam<Damage> {};

TEST_P(DamagedTile, IsRefused) {
  v1::TileFactors damaged = tile_factors();
  GetParam().damage(damaged);
  auto builder = FactorsBuilder::make(plan(), scene());
  const auto added = builder->add(tile(damaged));
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find(GetParam().message), std::string::npos)
      << added.error().message;
}

INSTANTIATE_TEST_SUITE_P(
    Factors, DamagedTile,
    testing::Values(
        Damage{"parent", [](auto& t) { t.set_product_parent(0, 1); }, "before its parent"},
        Damage{"material", [](auto& t) { t.set_signature_material(0, 2); }, "a material"},
        Damage{"fresnel", [](auto& t) { t.set_product_material(0, 0); }, "a Fresnel term"},
        Damage{"node", [](auto& t) { t.set_product_node(0, fresnel_nodes); }, "a node"},
        Damage{"light", [](auto& t) { t.set_signature_light(0, 1); }, "a light"},
        Damage{"product", [](auto& t) { t.set_signature_product(0, 2); }, "a product"},
        Damage{"signature", [](auto& t) { t.set_signature(0, 3); }, "a signature"},
        Damage{"length", [](auto& t) { t.add_product_node(0); }, "differ in length"},
        Damage{"count", [](auto& t) { t.set_count(0, 2); }, "do not fit its pixels"},
        Damage{"wrap", [](auto& t) { t.set_count(0, 0xffffffff); }, "do not fit its pixels"},
        Damage{"nan", [](auto& t) { t.set_weight(0, std::nanf("")); }, "not finite"}),
    [](const auto& info) { return info.param.name; });

class FactorsFile : public testing::Test {
 protected:
  FactorsFile() : file_(fs::temp_directory_path() / ("factors_test_" + std::to_string(getpid()))) {
    EXPECT_TRUE(write_factors(build(), file_));
    std::ifstream in(file_, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
  }
  ~FactorsFile() override { fs::remove(file_); }

  /// Why these bytes are refused; "" where they are not.
  std::string refused(const std::string& bytes) {
    std::ofstream(file_, std::ios::binary) << bytes;
    const auto factors = read_factors(file_);
    return factors ? "" : factors.error().message;
  }

  fs::path file_;
  std::string bytes_;
};

TEST_F(FactorsFile, HoldsWhatWasWritten) {
  const auto read = read_factors(file_);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->end, build().end);
  EXPECT_EQ(read->weight, build().weight);
  EXPECT_EQ(read->tables.SerializeAsString(), build().tables.SerializeAsString());
}

TEST_F(FactorsFile, OfAnyLengthButItsOwnIsRefused) {
  for (std::size_t size = 0; size < bytes_.size(); ++size)
    EXPECT_NE(refused(bytes_.substr(0, size)), "") << size;
  EXPECT_NE(refused(bytes_ + "x"), "");
}

TEST_F(FactorsFile, WithAnyByteChangedIsRefused) {
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    std::string changed = bytes_;
    changed[at] = static_cast<char>(changed[at] ^ 0x40);
    EXPECT_NE(refused(changed), "") << at;
  }
}

TEST_F(FactorsFile, OfAnotherKindOrVersionSaysSo) {
  EXPECT_EQ(refused("no factors at all, but longer than the head of a file of factors is"),
            "is no file of factors");
  std::string newer = bytes_;
  newer[8] = 2;
  EXPECT_EQ(refused(newer), "is a file of factors of version 2; this program reads version 1");
}

}  // namespace
}  // namespace metamer::client
