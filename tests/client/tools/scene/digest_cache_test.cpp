// A file that has not changed is read once; one that has is never mistaken for what it was.
#include "client/tools/scene/digest_cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <thread>

namespace metamer::client {
namespace {

namespace fs = std::filesystem;
using std::chrono::nanoseconds;

constexpr std::uint64_t limit = 1 << 20;

class Digests : public testing::Test {
 protected:
  void SetUp() override { fs::create_directory(folder); }
  void TearDown() override { fs::remove_all(folder); }

  fs::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary | std::ios::trunc) << bytes;
    return folder / name;
  }

  static nanoseconds changed(const fs::path& file) {
    struct stat status {};
    EXPECT_EQ(stat(file.c_str(), &status), 0);
    return std::chrono::seconds(status.st_ctim.tv_sec) + nanoseconds(status.st_ctim.tv_nsec);
  }

  /// Writes until the file system's clock, which ticks every few milliseconds, has moved on.
  fs::path write_later(const std::string& name, const std::string& bytes) {
    const nanoseconds before = changed(folder / name);
    do {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      write(name, bytes);
    } while (changed(folder / name) == before);
    return folder / name;
  }

  /// A clock by which every file here has long been at rest.
  static nanoseconds much_later() { return DigestCache::system_now() + std::chrono::hours(1); }

  fs::path folder = fs::temp_directory_path() / ("metamer-digests-" + std::to_string(getpid()));
};

TEST_F(Digests, AFileThatDoesNotChangeIsReadOnce) {
  const fs::path file = write("a", "0123456789");
  DigestCache cache(10, much_later);
  for (int i = 0; i < 3; ++i) {
    const auto digest = cache.digest(file, limit);
    ASSERT_TRUE(digest);
    EXPECT_EQ(digest->sha256, sha256("0123456789"));
    EXPECT_EQ(digest->size, 10u);
  }
  EXPECT_EQ(cache.files_read(), 1u);
}

TEST_F(Digests, OtherBytesOfTheSameSizeAreSeen) {
  const fs::path file = write("a", "aaaa");
  DigestCache cache(10, much_later);
  ASSERT_TRUE(cache.digest(file, limit));
  write_later("a", "bbbb");
  EXPECT_EQ(cache.digest(file, limit)->sha256, sha256("bbbb"));
  EXPECT_EQ(cache.files_read(), 2u);
}

TEST_F(Digests, ATimeThatWasSetBackHidesNothing) {
  const fs::path file = write("a", "aaaa");
  const auto time = fs::last_write_time(file);
  DigestCache cache(10, much_later);
  ASSERT_TRUE(cache.digest(file, limit));
  write_later("a", "bbbb");
  fs::last_write_time(file, time);
  EXPECT_EQ(cache.digest(file, limit)->sha256, sha256("bbbb"));
}

TEST_F(Digests, AFileThatTookItsPlaceIsSeen) {
  const fs::path file = write("a", "aaaa");
  const fs::path other = write("b", "bbbb");
  fs::last_write_time(other, fs::last_write_time(file));
  DigestCache cache(10, much_later);
  ASSERT_TRUE(cache.digest(file, limit));
  fs::rename(other, file);
  EXPECT_EQ(cache.digest(file, limit)->sha256, sha256("bbbb"));
}

// Within one tick of the file system's clock a file changes and keeps its times: what was written
// just now is not trusted.
TEST_F(Digests, QuickChangesOfTheSameSizeAreAllSeen) {
  DigestCache cache;
  for (int i = 1000; i < 1300; ++i) {
    const std::string bytes = std::to_string(i);
    const fs::path file = write("a", bytes);
    ASSERT_EQ(cache.digest(file, limit)->sha256, sha256(bytes)) << i;
  }
  EXPECT_EQ(cache.size(), 0u);
}

TEST_F(Digests, WhatChangesWhileItIsReadIsNotKept) {
  const fs::path file = write("a", "aaaa");
  bool once = true;
  DigestCache cache(10, [&] {
    if (std::exchange(once, false)) write_later("a", "bbbb");
    return much_later();
  });
  EXPECT_EQ(cache.digest(file, limit)->sha256, sha256("bbbb"));
  EXPECT_EQ(cache.size(), 0u);
  EXPECT_EQ(cache.digest(file, limit)->sha256, sha256("bbbb"));
  EXPECT_EQ(cache.size(), 1u);
}

TEST_F(Digests, KeepsNoMoreThanItsCapacity) {
  DigestCache cache(2, much_later);
  const fs::path a = write("a", "a"), b = write("b", "b"), c = write("c", "c");
  for (const fs::path& file : {a, b, a, c}) ASSERT_TRUE(cache.digest(file, limit));
  EXPECT_EQ(cache.size(), 2u);
  EXPECT_EQ(cache.files_read(), 3u);
  ASSERT_TRUE(cache.digest(a, limit));  // b was asked for before a was
  EXPECT_EQ(cache.files_read(), 3u);
  ASSERT_TRUE(cache.digest(b, limit));
  EXPECT_EQ(cache.files_read(), 4u);
}

TEST_F(Digests, ErrorsAreThoseOfReading) {
  DigestCache cache(10, much_later);
  EXPECT_EQ(cache.digest(folder / "gone", limit).error().message,
            digest_file(folder / "gone", limit).error().message);
  const fs::path file = write("a", "0123456789");
  ASSERT_TRUE(cache.digest(file, 10));
  EXPECT_EQ(cache.digest(file, 9).error().message, digest_file(file, 9).error().message);
  ASSERT_TRUE(cache.digest(file, 10));
  fs::remove(file);
  EXPECT_FALSE(cache.digest(file, 10));
}

}  // namespace
}  // namespace metamer::client
