// A task of a cluster and its worker, which is the fake one: what it renders, and what it makes of
// a worker that crashes, hangs or lies.
#include "server/batch/task.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstring>
#include <fstream>

#include "common/digest.h"
#include "common/wire/batch_file.h"
#include "server/batch/batch.h"

namespace metamer::batch {
namespace {

class BatchTask : public testing::Test {
 protected:
  BatchTask() { std::filesystem::create_directories(store_); }
  ~BatchTask() override { std::filesystem::remove_all(folder_); }

  /// An order for a scene that the fake worker reads.
  v1::BatchOrder order(const std::string& script) const {
    const Digest digest = sha256(script);
    std::ofstream(store_ / to_hex(digest)) << script;
    v1::BatchOrder order;
    order.set_job_id(5);
    order.set_attempt(3);
    order.set_assets(store_);
    order.set_result(folder_ / "3.result");
    order.mutable_compile()->set_scene_sha256(std::string(to_bytes(digest)));
    return order;
  }
  v1::BatchResult carry_out(const v1::BatchOrder& order) const {
    auto worker = OwnWorker::start(
        {.program = METAMER_BIN "/metamer-fake-worker", .store = store_, .threads = 1});
    if (!worker) {
      ADD_FAILURE() << worker.error().message;
      return {};
    }
    return Task(order, *worker).run(1);
  }
  v1::Plan plan_of(const std::string& script) const { return carry_out(order(script)).plan(); }

  static std::filesystem::path new_folder() {
    std::string path = "/tmp/metamer-task-XXXXXX";
    return ::mkdtemp(path.data());
  }
  std::filesystem::path folder_ = new_folder();
  std::filesystem::path store_ = folder_ / "store" / "worker-1";
};

/// As the fake worker draws it: a pixel is (x, y, 1).
void expect_tiles(const v1::BatchResult& result, const wire::TileGrid& grid) {
  for (int i = 0; i < result.tile_size(); ++i) {
    const wire::Rect rect = grid.rect(result.first() + static_cast<std::uint32_t>(i));
    const std::string& xyz = result.tile(i).xyz();
    ASSERT_EQ(xyz.size(), std::size_t{rect.width} * rect.height * 12);
    float last[3];
    std::memcpy(last, xyz.data() + xyz.size() - sizeof last, sizeof last);
    EXPECT_EQ(last[0], static_cast<float>(rect.x + rect.width - 1));
    EXPECT_EQ(last[1], static_cast<float>(rect.y + rect.height - 1));
    EXPECT_EQ(result.tile(i).rays(), 10u);
  }
}

TEST_F(BatchTask, PlansAndRendersAsFarAsItsTimeGoes) {
  v1::BatchOrder whole = order("picture 100 50 16");
  whole.set_seconds(30);
  const v1::BatchResult result = carry_out(whole);
  EXPECT_EQ(result.lost() + result.failed().reason(), "");
  EXPECT_EQ(result.attempt(), 3u);
  EXPECT_EQ(result.plan().width(), 100u);
  EXPECT_EQ(result.tile_size(), 28);
  expect_tiles(result, wire::TileGrid(100, 50, 16));

  whole.set_seconds(1e-9);
  EXPECT_EQ(carry_out(whole).tile_size(), 4);
}

TEST_F(BatchTask, RendersTheTilesOfARange) {
  v1::BatchOrder range = order("picture 100 50 16");
  *range.mutable_plan() = plan_of("picture 100 50 16");
  range.set_first(7);
  range.set_count(13);
  const v1::BatchResult result = carry_out(range);
  EXPECT_EQ(result.lost(), "");
  EXPECT_EQ(result.first(), 7u);
  EXPECT_EQ(result.tile_size(), 13);
  EXPECT_FALSE(result.has_plan());
  expect_tiles(result, wire::TileGrid(100, 50, 16));
}

TEST_F(BatchTask, CarriesFactors) {
  v1::BatchOrder kept = order("factors 200000");
  kept.mutable_compile()->set_keep_factors(true);
  kept.set_seconds(30);
  const v1::BatchResult result = carry_out(kept);
  EXPECT_EQ(result.lost(), "");
  EXPECT_EQ(result.scene_factors().size(), 200'000u);
  ASSERT_EQ(result.tile_size(), 12);
  for (const v1::BatchTile& tile : result.tile()) EXPECT_EQ(tile.factors().size(), 200'000u);
}

TEST_F(BatchTask, OfANodeThatPlansAnotherPictureIsLost) {
  v1::BatchOrder range = order("picture 100 50 16");
  *range.mutable_plan() = plan_of("picture 100 58 16");
  range.set_count(1);
  EXPECT_EQ(carry_out(range).lost(),
            "this node plans another picture than the one that planned the job");
}

TEST_F(BatchTask, OfAPlanIsTheSamePictureWhateverWasMeasuredOnTheWay) {
  v1::Plan a, b;
  a.set_width(10);
  b = a;
  b.set_threads(9);
  b.add_prediction()->set_render(3);
  b.add_need("a check: about 3 times the work");
  EXPECT_TRUE(same_picture(a, b));
  b.set_spp(4);
  EXPECT_FALSE(same_picture(a, b));
}

TEST_F(BatchTask, SaysHowItsWorkerWasLostAndGivesNothingOfIt) {
  for (const auto& [script, why] : std::vector<std::pair<std::string, std::string>>{
           {"crash 2", "killed by signal 6 (Aborted)"},
           {"exit 2", "exited with code 3"},
           {"stray", "sent a tile that was not asked for"},
           {"early", "said that tiles are done which are not"},
           {"garbage 2", "sent what can't be read: "}}) {
    v1::BatchOrder whole = order(script);
    whole.set_seconds(30);
    const v1::BatchResult result = carry_out(whole);
    EXPECT_TRUE(result.lost().starts_with(why)) << script << ": " << result.lost();
    EXPECT_EQ(result.tile_size(), 0) << script;
  }
}

TEST_F(BatchTask, PassesOnWhatIsTheScenesFault) {
  v1::BatchOrder bad = order("fail");
  bad.set_seconds(30);
  const v1::BatchResult result = carry_out(bad);
  EXPECT_EQ(result.failed().kind(), v1::Failed::BAD_INPUT);
  EXPECT_EQ(result.lost(), "");
}

TEST_F(BatchTask, OfAnotherProgramIsLostBeforeItBegins) {
  v1::BatchOrder other = order("picture 100 50 16");
  other.set_build("0123");
  ASSERT_TRUE(wire::write_batch_file(folder_ / "0.order", other));
  EXPECT_EQ(
      run_batch({.order = folder_ / "0.order", .program = METAMER_BIN "/metamer-fake-worker"}), 0);
  const auto result = wire::read_batch_result(other.result());
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_NE(result->lost().find("is not the server's metamer-worker"), std::string::npos);
  EXPECT_FALSE(result->node().empty());
}

}  // namespace
}  // namespace metamer::batch
