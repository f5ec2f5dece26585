#include "server/service/store/tile_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "../temporary_state.h"

namespace metamer::service {
namespace {

/// CRC-32C bit by bit, as RFC 3720 has it, without the last inversion.
std::uint32_t slow_crc(std::string_view bytes) {
  std::uint32_t sum = ~0u;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ (0x82f63b78u & (0u - (sum & 1)));
  }
  return sum;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

struct TileFiles : testing::Test {
  test::TemporaryState state;
  std::filesystem::path path = state.path() / "7.tiles";

  std::vector<TileFile::Entry> written;
  TileFile file{path};
  void add(std::uint32_t tile, const std::string& xyz, const std::string& factors = "") {
    TileFile::Entry entry{.tile = tile, .sequence = 10 + tile, .rays = 3, .time = 0.5};
    const std::string record = file.encode(entry, xyz, factors);
    TileFile::write(path, entry.offset, record);
    written.push_back(entry);
  }
};

TEST(SlowCrc, IsThePublishedOne) { EXPECT_EQ(~slow_crc("123456789"), 0xe3069283u); }

TEST_F(TileFiles, GiveBackWhatWasWritten) {
  add(4, "pixels", "factors");
  add(0, "", "");
  add(TileFile::scene, "", "of the scene");
  TileFile::sync(path);
  TileFile again(path);
  const auto found = again.scan().value();
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].tile, 4u);
  EXPECT_EQ(found[0].sequence, 14u);
  EXPECT_EQ(found[0].rays, 3u);
  EXPECT_EQ(found[0].time, 0.5);
  EXPECT_EQ(again.read(found[0]).value().xyz, "pixels");
  EXPECT_EQ(again.read(found[0]).value().factors, "factors");
  EXPECT_EQ(again.read(found[2]).value().factors, "of the scene");
  EXPECT_EQ(again.size(), std::filesystem::file_size(path));
}

TEST_F(TileFiles, AreAsTheHeaderSays) {
  add(2, "abc", "d");
  std::string bytes = bytes_of(path);
  ASSERT_EQ(bytes.size(), 8u + 40 + 4);
  EXPECT_EQ(bytes.substr(0, 8), "MTMTILE1");
  EXPECT_EQ(bytes.substr(8, 12), std::string("\2\0\0\0\3\0\0\0\1\0\0\0", 12));
  std::uint32_t sum = 0;
  bytes.copy(reinterpret_cast<char*>(&sum), 4, 20);
  EXPECT_EQ(sum, slow_crc(bytes.substr(8).replace(12, 4, 4, '\0')));
}

TEST_F(TileFiles, ThatAreNotThereAreEmpty) {
  EXPECT_TRUE(file.scan().value().empty());
  EXPECT_EQ(file.size(), TileFile::head_bytes);
}

TEST_F(TileFiles, AreCutWhereverACrashLeavesThem) {
  add(0, "first");
  const std::uint64_t whole = file.size();
  add(1, "second", "more");
  const std::string all = bytes_of(path);
  for (std::size_t size = 0; size < all.size(); ++size) {
    write_bytes(path, all.substr(0, size));
    TileFile again(path);
    const auto found = again.scan();
    ASSERT_TRUE(found) << size;
    ASSERT_EQ(found->size(), size < whole ? 0u : 1u) << size;
    EXPECT_EQ(again.size(), size < whole ? TileFile::head_bytes : whole) << size;
  }
}

TEST_F(TileFiles, NoFlippedBitPasses) {
  add(0, "first");
  add(1, "second", "more");
  const std::string all = bytes_of(path);
  for (std::size_t bit = 0; bit < 8 * all.size(); ++bit) {
    std::string bad = all;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    write_bytes(path, bad);
    TileFile again(path);
    const auto found = again.scan();
    if (bit < 64) {
      EXPECT_FALSE(found) << bit;
      continue;
    }
    ASSERT_TRUE(found);
    // What is given is what was written; sequence, rays and time are under the sum, too.
    for (const TileFile::Entry& entry : *found) {
      const auto contents = again.read(entry);
      if (!contents) continue;
      ASSERT_LT(entry.tile, 2u);
      EXPECT_EQ(entry.sequence, written[entry.tile].sequence) << bit;
      EXPECT_EQ(contents->xyz, entry.tile == 0 ? "first" : "second") << bit;
    }
  }
}

TEST_F(TileFiles, GoOnBehindWhatIsWhole) {
  add(0, "first");
  const std::uint64_t whole = file.size();
  TileFile::write(path, whole, "half a rec");
  TileFile again(path);
  ASSERT_EQ(again.scan().value().size(), 1u);
  TileFile::cut(path, again.size());
  TileFile::Entry entry{.tile = 1};
  const std::string record = again.encode(entry, "second", "");
  TileFile::write(path, entry.offset, record);
  TileFile last(path);
  EXPECT_EQ(last.scan().value().size(), 2u);
}

TEST_F(TileFiles, AnotherKindOfFileIsAnError) {
  write_bytes(path, "%PDF-1.4 and so on");
  EXPECT_FALSE(file.scan());
}

std::size_t open_descriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

TEST_F(TileFiles, WhatIsReadTakesADescriptorOnlyMeanwhileUnlessItsNameMayGo) {
  add(4, "pixels");
  const std::size_t before = open_descriptors();
  ASSERT_TRUE(file.scan());
  ASSERT_TRUE(file.read(written[0]));
  EXPECT_EQ(open_descriptors(), before);
  file.open();
  file.open();
  EXPECT_EQ(open_descriptors(), before + 1);
  TileFile::remove(path);
  EXPECT_EQ(file.read(written[0]).value().xyz, "pixels");
}

}  // namespace
}  // namespace metamer::service
