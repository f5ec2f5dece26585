#include "server/service/assets/asset_store.h"

#include <gtest/gtest.h>

#include <boost/asio.hpp>
#include <fstream>

#include "common/scene/limits.h"
#include "server/service/assets/asset_folder.h"
#include "server/service/ops/folders.h"
#include "tests/server/cpu/soft/sky_file.h"

namespace metamer::service {

namespace {

namespace fs = std::filesystem;

class AssetStoreTest : public testing::Test {
 protected:
  void open(std::uint64_t quota) { store_ = AssetStore::open(folder(), quota).value(); }
  std::filesystem::path folder() const { return folder_.path() / "store"; }
  std::size_t files() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
      count += entry.is_regular_file();
    }
    return count;
  }
  tl::expected<void, Refusal> put(const std::string& bytes) {
    auto upload = AssetUpload::begin(*store_, {}, sha256(bytes), bytes.size());
    if (!upload) return tl::unexpected(upload.error());
    if (auto added = upload->add(0, bytes); !added) return added;
    return upload->commit();
  }

  /// What a request does that names it.
  bool has_after_a_look(const std::string& bytes) const {
    asio::io_context context;
    asio::co_spawn(context, store_->look({sha256(bytes)}), asio::detached);
    context.run();
    return store_->has(sha256(bytes));
  }
  fs::path file(const std::string& bytes) const { return store_->file(sha256(bytes)); }

  TemporaryFolder folder_ = TemporaryFolder::make().value();
  std::shared_ptr<AssetStore> store_;
};

std::string text(char c, std::size_t size) { return std::string(size, c); }

}  // namespace

TEST_F(AssetStoreTest, PiecesInOrderBecomeAFileNamedByItsDigest) {
  open(1000);
  const std::string bytes = "one two three";
  const Digest digest = sha256(bytes);
  auto upload = AssetUpload::begin(*store_, {}, digest, bytes.size()).value();
  ASSERT_TRUE(upload.add(0, bytes.substr(0, 4)));
  EXPECT_FALSE(upload.complete());
  EXPECT_FALSE(store_->has(digest));
  ASSERT_TRUE(upload.add(4, bytes.substr(4)));
  ASSERT_TRUE(upload.complete());
  ASSERT_TRUE(upload.commit());
  EXPECT_TRUE(store_->has(digest));
  EXPECT_EQ(store_->bytes(), bytes.size());
  std::ifstream file(folder() / to_hex(digest));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), bytes);
}

TEST_F(AssetStoreTest, AnEmptyAssetIsAnAssetToo) {
  open(1000);
  EXPECT_TRUE(put(""));
  EXPECT_TRUE(store_->has(sha256("")));
}

TEST_F(AssetStoreTest, KnowsWhatItsPicturesBecomeBeforeAndAfterItsEnd) {
  using Pixels = std::vector<std::array<float, 3>>;
  const std::string small = metamer::test::sky_file(2, 3, Pixels(6)),
                    large = metamer::test::sky_file(8, 4, Pixels(32));
  open(10'000);
  for (const std::string& bytes : {small, large, text('a', 100)}) ASSERT_TRUE(put(bytes));
  for (const bool again : {false, true}) {
    if (again) store_.reset();
    if (again) open(10'000);
    AssetHolds holds(*store_);
    for (const std::string& bytes : {small, large, text('a', 100)})
      ASSERT_TRUE(holds.add(sha256(bytes)));
    EXPECT_EQ(holds.pictures().values, 18u + 96u);
    EXPECT_EQ(holds.pictures().largest, 96u);
  }
}

TEST_F(AssetStoreTest, WrongBytesAreRefusedAndLeaveNothing) {
  open(1000);
  {
    auto upload = AssetUpload::begin(*store_, {}, sha256("right"), 5).value();
    ASSERT_TRUE(upload.add(0, "wrong"));
    const auto refused = upload.commit();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, v1::Error::DIGEST);
    EXPECT_EQ(refused.error().message, "the asset offered as " + to_hex(sha256("right")) +
                                           " has the digest " + to_hex(sha256("wrong")));
  }
  EXPECT_EQ(store_->bytes(), 0u);
  EXPECT_EQ(files(), 0u);
}

TEST_F(AssetStoreTest, PiecesOutOfOrderAreRefused) {
  open(1000);
  auto upload = AssetUpload::begin(*store_, {}, sha256("abcdef"), 6).value();
  ASSERT_TRUE(upload.add(0, "ab"));
  EXPECT_EQ(upload.add(0, "ab").error().message, "a chunk at offset 0 came where offset 2 was due");
  EXPECT_EQ(upload.add(4, "ef").error().message, "a chunk at offset 4 came where offset 2 was due");
  EXPECT_EQ(upload.add(2, "cdefg").error().message, "a chunk ends beyond its asset's 6 bytes");
  EXPECT_EQ(upload.add(2, "cdefg").error().code, v1::Error::ORDER);
}

TEST_F(AssetStoreTest, SizesBeyondTheLimitAreRefusedBeforeTheyCome) {
  open(~0ull >> 1);
  const auto refused = AssetUpload::begin(*store_, {}, sha256("x"), limits::max_asset + 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, v1::Error::LIMIT);
  EXPECT_EQ(refused.error().message,
            "an asset of 1073741825 bytes is over the limit of 1073741824");
}

TEST_F(AssetStoreTest, TheAssetsUnusedForLongestMakeRoom) {
  open(100);
  ASSERT_TRUE(put(text('a', 40)));
  ASSERT_TRUE(put(text('b', 40)));
  { AssetHolds(*store_).add(sha256(text('a', 40))); }  // used after b
  ASSERT_TRUE(put(text('c', 40)));
  EXPECT_TRUE(store_->has(sha256(text('a', 40))));
  EXPECT_FALSE(store_->has(sha256(text('b', 40))));
  EXPECT_TRUE(store_->has(sha256(text('c', 40))));
  EXPECT_EQ(store_->bytes(), 80u);
  EXPECT_EQ(files(), 2u);
}

TEST_F(AssetStoreTest, WhatIsHeldStaysAndAFullStoreSaysSo) {
  open(100);
  ASSERT_TRUE(put(text('a', 60)));
  AssetHolds holds(*store_);
  ASSERT_TRUE(holds.add(sha256(text('a', 60))));
  const auto refused = put(text('b', 60));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, v1::Error::LIMIT);
  EXPECT_EQ(refused.error().message,
            "the asset store is full: 60 bytes do not fit beside the 60 in use; its quota is 100");
  // What others have is not everybody's to know.
  const auto ann = std::make_shared<Account>(Account{.name = "ann"});
  const auto hers = AssetUpload::begin(*store_, ann, sha256("x"), 60);
  ASSERT_FALSE(hers);
  EXPECT_EQ(hers.error().message,
            "the asset store is full: 60 bytes do not fit beside what is in use; its quota is 100");
  holds.clear();
  EXPECT_TRUE(put(text('b', 60)));
  EXPECT_FALSE(store_->has(sha256(text('a', 60))));
}

TEST_F(AssetStoreTest, AnUploadTakesRoomAsItsBytesCome) {
  open(100);
  auto upload = AssetUpload::begin(*store_, {}, sha256("x"), 80).value();
  EXPECT_EQ(store_->bytes(), 0u);
  ASSERT_TRUE(upload.add(0, text('x', 30)));
  EXPECT_EQ(store_->bytes(), 30u);
  ASSERT_TRUE(put(text('b', 40)));
  AssetHolds holds(*store_);
  ASSERT_TRUE(holds.add(sha256(text('b', 40))));
  const auto refused = upload.add(30, text('x', 50));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, v1::Error::LIMIT);
  { auto gone = std::move(upload); }
  EXPECT_EQ(store_->bytes(), 40u);
  EXPECT_EQ(files(), 1u);
}

TEST_F(AssetStoreTest, OneAccountLeavesRoomForTheNext) {
  open(800);
  const auto greedy = std::make_shared<Account>(Account{.name = "uid 1000"});
  const auto other = std::make_shared<Account>(Account{.name = "uid 1001"});
  std::vector<AssetHolds> holds;
  const auto put_and_hold = [&](const AccountPtr& account, const std::string& bytes) {
    auto upload = AssetUpload::begin(*store_, account, sha256(bytes), bytes.size());
    if (!upload || !upload->add(0, bytes) || !upload->commit()) return false;
    return holds.emplace_back(*store_, account).add(sha256(bytes));
  };
  char next = 'a';
  while (put_and_hold(greedy, text(next, 50))) ++next;
  EXPECT_EQ(greedy->asset_bytes, 700u);  // 7/8
  EXPECT_TRUE(put_and_hold(other, "a scene"));
  const auto refused = AssetUpload::begin(*store_, greedy, sha256("more"), 4);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "uid 1000 has its share of the asset store: 700 of its 800 bytes");
  // What several of its jobs name is kept once.
  holds.emplace_back(*store_, greedy).add(sha256(text('a', 50)));
  EXPECT_EQ(greedy->asset_bytes, 700u);
  holds.clear();
  EXPECT_EQ(greedy->asset_bytes, 0u);
  EXPECT_EQ(other->asset_bytes, 0u);
}

TEST_F(AssetStoreTest, TheSameAssetTwiceAtATimeIsStoredOnce) {
  open(100);
  auto first =
      std::make_unique<AssetUpload>(AssetUpload::begin(*store_, {}, sha256("abc"), 3).value());
  auto second =
      std::make_unique<AssetUpload>(AssetUpload::begin(*store_, {}, sha256("abc"), 3).value());
  ASSERT_TRUE(first->add(0, "abc"));
  ASSERT_TRUE(second->add(0, "abc"));
  ASSERT_TRUE(first->commit());
  ASSERT_TRUE(second->commit());
  first.reset();
  second.reset();
  EXPECT_TRUE(store_->has(sha256("abc")));
  EXPECT_EQ(store_->bytes(), 3u);
  EXPECT_EQ(files(), 1u);
}

TEST_F(AssetStoreTest, AReopenedStoreHasItsAssetsButNoneThatIsDamaged) {
  open(1000);
  for (const char* const bytes : {"good", "bad", "short"}) ASSERT_TRUE(put(bytes));
  store_.reset();
  std::ofstream(folder() / to_hex(sha256("bad"))) << "bat";
  std::ofstream(folder() / to_hex(sha256("short"))) << "sh";
  std::ofstream(folder() / "upload-7") << "half an upl";
  std::ofstream(folder() / "notes.txt") << "not ours";
  open(1000);
  EXPECT_TRUE(has_after_a_look("good"));
  EXPECT_FALSE(has_after_a_look("bad"));
  EXPECT_FALSE(has_after_a_look("short"));
  EXPECT_EQ(files(), 4u);  // three assets, and the file that is none of ours

  // They are counted as they are once they have come anew.
  EXPECT_EQ(store_->bytes(), 9u);
  for (const char* const bytes : {"bad", "short"}) ASSERT_TRUE(put(bytes));
  for (const char* const bytes : {"good", "bad", "short"}) EXPECT_TRUE(has_after_a_look(bytes));
  EXPECT_EQ(store_->bytes(), 12u);
}

TEST_F(AssetStoreTest, OneThatWasShorterAtTheStartIsItsHoldersAsItIs) {
  open(1000);
  ASSERT_TRUE(put("short"));
  store_.reset();
  std::ofstream(folder() / to_hex(sha256("short"))) << "sh";
  open(1000);
  const auto account = std::make_shared<Account>(Account{.name = "uid 1000"});
  {
    AssetHolds holds(*store_, account);
    ASSERT_TRUE(holds.add(sha256("short"))) << "nobody has looked yet";
    EXPECT_TRUE(has_after_a_look("short") == false && holds.damaged());
    ASSERT_TRUE(put("short"));
    EXPECT_FALSE(holds.damaged());
    EXPECT_EQ(account->asset_bytes, 5u);
  }
  EXPECT_EQ(account->asset_bytes, 0u);
  EXPECT_TRUE(put(text('a', 1000))) << "nothing is kept";
}

TEST_F(AssetStoreTest, NobodyWaitsForAStoreThatIsStopped) {
  open(1000);
  ASSERT_TRUE(put("bytes"));
  store_.reset();
  open(1000);
  store_->stop();
  EXPECT_TRUE(has_after_a_look("bytes")) << "the worker judges";
}

TEST_F(AssetStoreTest, LinksAreNoChangeOfAFileButHideNone) {
  open(1000);
  for (const char* const bytes : {"same", "else"}) ASSERT_TRUE(put(bytes));
  AssetHolds holds(*store_);
  const auto folder = AssetFolder::make(this->folder()).value();
  for (const char* const bytes : {"same", "else"}) ASSERT_TRUE(holds.add(sha256(bytes)));
  std::fstream(file("else"), std::ios::in | std::ios::out).put('E');
  ASSERT_TRUE(folder->show({&holds}));
  ASSERT_TRUE(folder->show({}));
  EXPECT_TRUE(has_after_a_look("same"));
  EXPECT_EQ(store_->readings(), 0u);
  EXPECT_FALSE(has_after_a_look("else"));
  EXPECT_EQ(store_->readings(), 1u);
}

TEST_F(AssetStoreTest, AFileThatAWorkerDoubtsIsReadOnce) {
  open(1000);
  for (const char* const bytes : {"seen", "other"}) ASSERT_TRUE(put(bytes));
  AssetHolds holds(*store_);
  ASSERT_TRUE(holds.add(sha256("seen")));
  const auto worker = AssetFolder::make(folder()).value();
  ASSERT_TRUE(worker->show({&holds}));
  worker->doubt(sha256("other"));
  EXPECT_TRUE(has_after_a_look("other"));
  EXPECT_EQ(store_->readings(), 0u) << "it can't know that one";
  worker->doubt(sha256("seen"));
  EXPECT_TRUE(has_after_a_look("seen"));
  EXPECT_TRUE(has_after_a_look("seen"));
  EXPECT_EQ(store_->readings(), 1u);
}

TEST_F(AssetStoreTest, AWorkerIsGivenTheFileThatCameAnew) {
  open(1000);
  ASSERT_TRUE(put("bytes"));
  AssetHolds holds(*store_);
  ASSERT_TRUE(holds.add(sha256("bytes")));
  const auto worker = AssetFolder::make(folder()).value();
  ASSERT_TRUE(worker->show({&holds}));
  std::fstream(file("bytes"), std::ios::in | std::ios::out).put('B');
  EXPECT_FALSE(has_after_a_look("bytes"));
  ASSERT_TRUE(put("bytes"));
  ASSERT_TRUE(worker->show({&holds}));
  std::ifstream seen(worker->path() / to_hex(sha256("bytes")));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(seen), {}), "bytes");
}

TEST_F(AssetStoreTest, AFolderThatCannotBeMadeIsAnError) {
  std::ofstream(folder_.path() / "file") << "x";
  const auto store = AssetStore::open(folder_.path() / "file" / "store", 1000);
  ASSERT_FALSE(store);
  EXPECT_EQ(store.error().message, "can't make the store's folder " +
                                       (folder_.path() / "file" / "store").string() +
                                       ": Not a directory");
}

}  // namespace metamer::service
