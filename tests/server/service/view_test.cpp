// A view between its client and its worker, neither of which is believed.

#include "server/service/view.h"

#include <gtest/gtest.h>

#include "server/service/folders.h"
#include "server/service/limits.h"

namespace metamer::service {
namespace {

v1::FrameBand band(std::uint32_t first_row, std::uint32_t rows, bool last) {
  v1::FrameBand message;
  message.set_width(8);
  message.set_height(6);
  message.set_first_row(first_row);
  message.set_rgb(std::string(std::size_t{rows} * 8 * 3, '\x7f'));
  if (last) message.mutable_frame()->set_samples(1);
  return message;
}

v1::ViewEvent event(const v1::FrameBand& band) {
  v1::ViewEvent message;
  *message.mutable_band() = band;
  return message;
}

v1::ViewEvent updated(std::uint64_t revision, bool planned) {
  v1::ViewEvent message;
  message.mutable_updated()->set_revision(revision);
  if (planned) message.mutable_updated()->mutable_plan()->set_width(8);
  return message;
}

v1::UpdateView light(const std::string& name, double luminance, std::uint64_t revision) {
  v1::UpdateView message;
  message.set_revision(revision);
  message.add_light()->set_name(name);
  message.mutable_light(0)->set_luminance(luminance);
  return message;
}

class ViewTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(view_.take(updated(0, true))); }
  /// What waits for the client, in words.
  std::string unsent() {
    std::string text;
    while (const auto event = view_.next()) {
      if (event->has_updated())
        text += "updated " + std::to_string(event->updated().revision()) +
                (event->updated().has_plan() ? " planned" : "");
      if (event->has_refused()) text += "refused";
      if (event->has_band()) text += "row " + std::to_string(event->band().first_row());
      if (event->has_closed()) text += "closed " + event->closed().reason().reason();
      text += "; ";
    }
    return text;
  }

  TemporaryFolder folder_ = TemporaryFolder::make().value();
  std::shared_ptr<AssetStore> store_ = AssetStore::open(folder_.path() / "store", 1000).value();
  int woken_ = 0;
  View view_{7, {}, AssetHolds(*store_), [this] { ++woken_; }};
};

TEST_F(ViewTest, UpdatesThatComeMeanwhileAreOne) {
  const auto first = view_.update(light("a", 1, 1));
  ASSERT_TRUE(first && *first);
  EXPECT_EQ((*first)->update_view().revision(), 1u);
  EXPECT_EQ((*first)->update_view().view_id(), 7u);
  // The worker has not answered.
  EXPECT_FALSE(*view_.update(light("a", 2, 2)));
  EXPECT_FALSE(*view_.update(light("b", 3, 3)));
  EXPECT_FALSE(*view_.update(light("a", 4, 4)));
  const auto next = view_.take(updated(1, false));
  ASSERT_TRUE(next && *next);
  const v1::UpdateView& merged = (*next)->update_view();
  EXPECT_EQ(merged.revision(), 4u);
  ASSERT_EQ(merged.light_size(), 2);
  EXPECT_EQ(merged.light(0).luminance(), 4);
  EXPECT_EQ(merged.light(1).luminance(), 3);
  EXPECT_FALSE(*view_.take(updated(4, false)));
}

TEST_F(ViewTest, UpdatesThatWaitDoNotGrowWithoutBound) {
  ASSERT_TRUE(view_.update(light("a", 1, 1)));
  bool refused = false;
  for (int i = 0; i < 10'000 && !refused; ++i)
    refused = !view_.update(light(std::to_string(i) + std::string(150, 'n'), 1, 2));
  EXPECT_TRUE(refused);
}

TEST_F(ViewTest, OfUnsentAnswersTheNewestIsEnough) {
  for (std::uint64_t revision = 1; revision <= 5; ++revision) {
    ASSERT_TRUE(view_.update(light("a", 1, revision)));
    ASSERT_TRUE(view_.take(updated(revision, revision == 3)));
  }
  // The plan of the third one is the newest there is.
  EXPECT_EQ(unsent(), "updated 5 planned; ");
}

TEST_F(ViewTest, AClientHasAtMostTwoFramesComing) {
  ASSERT_TRUE(view_.next_frame());
  ASSERT_TRUE(view_.next_frame());
  const auto third = view_.next_frame();
  ASSERT_FALSE(third);
  EXPECT_EQ(third.error().message, "a view has at most 2 frames coming");
  // It is coming until it has been sent.
  ASSERT_TRUE(view_.take(event(band(0, 6, true))));
  EXPECT_FALSE(view_.next_frame());
  EXPECT_EQ(unsent(), "updated 0 planned; row 0; ");
  EXPECT_TRUE(view_.next_frame());
}

TEST_F(ViewTest, AFrameIsWholeRowsInOrder) {
  ASSERT_TRUE(view_.next_frame());
  ASSERT_TRUE(view_.take(event(band(0, 4, false))));
  ASSERT_TRUE(view_.take(event(band(4, 2, true))));
  EXPECT_EQ(unsent(), "updated 0 planned; row 0; row 4; ");
}

TEST_F(ViewTest, AWorkerThatLiesIsFoundOut) {
  EXPECT_FALSE(view_.take(event(band(0, 6, true)))) << "no frame was asked for";
  EXPECT_FALSE(view_.take(updated(1, false))) << "nothing was updated";
  EXPECT_FALSE(view_.take({})) << "nothing at all";
  ASSERT_TRUE(view_.next_frame());
  EXPECT_FALSE(view_.take(event(band(2, 4, true)))) << "the first rows are missing";
  EXPECT_FALSE(view_.take(event(band(0, 7, true)))) << "more rows than there are";
  EXPECT_FALSE(view_.take(event(band(0, 5, true)))) << "the last row is missing";
  v1::FrameBand huge = band(0, 6, true);
  huge.set_width(1u << 31);
  EXPECT_FALSE(view_.take(event(huge)));
  v1::FrameBand empty = band(0, 0, false);
  EXPECT_FALSE(view_.take(event(empty)));
}

TEST_F(ViewTest, AfterItsEndItHasNothingToSay) {
  EXPECT_EQ(unsent(), "updated 0 planned; ");
  v1::ViewClosed closed;
  closed.mutable_reason()->set_reason("lost");
  view_.end(closed);
  view_.end({});
  EXPECT_TRUE(view_.ended());
  EXPECT_EQ(unsent(), "closed lost; ");
  EXPECT_GT(woken_, 0);
}

TEST_F(ViewTest, AnAssetThatTheStoreLacksIsRefused) {
  v1::UpdateView change = light("a", 1, 1);
  change.add_asset()->set_name("lamp.txt");
  change.mutable_asset(0)->set_sha256(std::string(32, 'x'));
  const auto refused = view_.update(change);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, v1::Error::MISSING_ASSET);
  EXPECT_EQ(refused.error().message, "the store lacks lamp.txt");
  change.mutable_asset(0)->set_sha256("short");
  EXPECT_EQ(view_.update(change).error().message, "a digest has 32 bytes, not 5");
}

}  // namespace
}  // namespace metamer::service
