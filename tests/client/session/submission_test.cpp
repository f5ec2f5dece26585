// What is sent: the same bytes for the same scene, each file once, in pieces that fit.
#include "client/session/submission.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  void SetUp() override { fs::create_directory(folder); }
  void TearDown() override { fs::remove_all(folder); }

  Asset asset(const std::string& name, const std::string& bytes) {
    Asset result;
    result.name = name;
    result.path = folder / name;
    result.size = bytes.size();
    result.sha256 = sha256(bytes);
    std::ofstream(result.path, std::ios::binary) << bytes;
    return result;
  }

  fs::path folder = fs::temp_directory_path() / ("metamer-submission-" + std::to_string(getpid()));
};

/// The upload's bytes as its pieces bring them.
std::string sent(const Upload& upload, std::uint64_t chunk) {
  Answer<Chunks> chunks = Chunks::open(upload, chunk);
  EXPECT_TRUE(chunks);
  std::string bytes;
  int pieces = 0;
  while (!chunks->done()) {
    const Answer<v1::AssetChunk> piece = chunks->next();
    if (!piece) return "error: " + piece.error().message;
    EXPECT_EQ(piece->size(), upload.size);
    EXPECT_EQ(piece->offset(), bytes.size());
    EXPECT_LE(piece->data().size(), chunk);
    EXPECT_EQ(piece->sha256(), to_bytes(upload.sha256));
    bytes += piece->data();
    ++pieces;
  }
  EXPECT_EQ(pieces, std::max<std::uint64_t>(1, (upload.size + chunk - 1) / chunk));
  return bytes;
}

TEST_F(Files, ComeInPiecesThatMakeThemUp) {
  const std::string bytes = "0123456789";
  const Submission submission = make_submission({}, {asset("a", bytes)}, "s.txtpb", false);
  ASSERT_EQ(submission.uploads.size(), 2u);
  for (const std::uint64_t chunk : {1u, 3u, 5u, 10u, 11u})
    EXPECT_EQ(sent(submission.uploads[1], chunk), bytes) << chunk;
}

TEST_F(Files, EmptyOnesAreOnePiece) {
  const Submission submission = make_submission({}, {asset("a", "x"), asset("b", "")}, "s", false);
  ASSERT_EQ(submission.uploads.size(), 2u);  // b is as empty as the scene
  EXPECT_EQ(sent(submission.uploads[0], 4), "");
}

TEST_F(Files, OfEqualBytesAreSentOnceAndNamedTwice) {
  const Submission submission =
      make_submission({}, {asset("a", "same"), asset("b", "same")}, "s", true);
  EXPECT_EQ(submission.uploads.size(), 2u);
  ASSERT_EQ(submission.request.asset_size(), 2);
  EXPECT_EQ(submission.request.asset(0).name(), "a");
  EXPECT_EQ(submission.request.asset(1).name(), "b");
  EXPECT_EQ(submission.request.asset(0).sha256(), submission.request.asset(1).sha256());
  EXPECT_TRUE(submission.request.check_only());
}

TEST_F(Files, ThatChangeWhileTheyAreSentAreAnError) {
  const Submission submission = make_submission({}, {asset("a", "ten bytes!")}, "s", false);
  fs::resize_file(folder / "a", 5);
  EXPECT_EQ(sent(submission.uploads[1], 4),
            "error: " + (folder / "a").string() + " changed while it was being sent");
}

TEST_F(Files, ThatAreGoneAreAnError) {
  const Submission submission = make_submission({}, {asset("a", "x")}, "s", false);
  fs::remove(folder / "a");
  const Answer<Chunks> chunks = Chunks::open(submission.uploads[1], 4);
  ASSERT_FALSE(chunks);
  EXPECT_EQ(chunks.error().message, "cannot read " + (folder / "a").string());
}

TEST(Scene, IsAnAssetThatIsNamedByItsDigest) {
  v1::Scene scene;
  scene.add_light()->set_name("lamp");
  const Submission submission = make_submission(scene, {}, "s.txtpb", false);
  EXPECT_EQ(submission.request.name(), "s.txtpb");
  const std::string bytes = serialise(scene);
  EXPECT_EQ(submission.request.scene_sha256(), to_bytes(sha256(bytes)));
  EXPECT_EQ(sent(submission.uploads[0], 1 << 20), bytes);
  v1::Scene read;
  ASSERT_TRUE(read.ParseFromString(bytes));
  EXPECT_EQ(serialise(read), bytes);
}

}  // namespace
}  // namespace metamer::client
