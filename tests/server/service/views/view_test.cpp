// A view between its client and its worker, neither of which is believed.

#include "server/service/views/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "server/service/limits.h"
#include "server/service/ops/folders.h"
#include "server/service/views/views.h"

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
  if (planned) {
    message.mutable_updated()->mutable_plan()->set_width(8);
    message.mutable_updated()->mutable_plan()->set_height(6);
  }
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
      if (event->has_probed()) text += "probed " + std::to_string(event->probed().number());
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

TEST_F(ViewTest, XyzAreThoseOfACompleteFrameThatWasAskedForWithThem) {
  v1::FrameBand first = band(0, 4, false), last = band(4, 2, true);
  const auto with = [](v1::FrameBand band, std::size_t values) {
    band.set_xyz(std::string(values * sizeof(float), '\0'));
    return event(band);
  };
  last.mutable_frame()->set_complete(true);
  ASSERT_TRUE(view_.next_frame(true));
  ASSERT_TRUE(view_.take(with(first, 4 * 8 * 3)));
  ASSERT_TRUE(view_.take(with(last, 2 * 8 * 3)));
  EXPECT_EQ(unsent(), "updated 0 planned; row 0; row 4; ");

  const auto is_refused = [&](bool asked, const v1::ViewEvent& one, const v1::ViewEvent& other) {
    View view(1, {}, AssetHolds(*store_), [] {});
    EXPECT_TRUE(view.take(updated(0, true)) && view.next_frame(asked));
    return !view.take(one) || !view.take(other);
  };
  EXPECT_FALSE(is_refused(true, with(first, 4 * 8 * 3), with(last, 2 * 8 * 3)));
  EXPECT_TRUE(is_refused(true, event(first), event(last))) << "they are missing";
  EXPECT_TRUE(is_refused(true, with(first, 4 * 8 * 3), event(last))) << "some are";
  EXPECT_TRUE(is_refused(true, event(first), with(last, 2 * 8 * 3))) << "some are";
  EXPECT_TRUE(is_refused(true, with(first, 4 * 8 * 3 - 1), with(last, 2 * 8 * 3))) << "one is";
  EXPECT_TRUE(is_refused(false, with(first, 4 * 8 * 3), with(last, 2 * 8 * 3))) << "nobody asked";
  last.mutable_frame()->set_complete(false);
  EXPECT_TRUE(is_refused(true, with(first, 4 * 8 * 3), with(last, 2 * 8 * 3))) << "too early";
  EXPECT_FALSE(is_refused(true, event(first), event(last)));
}

v1::Probe place(std::uint64_t number, std::uint32_t x, std::uint32_t y, std::uint32_t side = 1) {
  v1::Probe message;
  message.set_number(number);
  message.set_x(x);
  message.set_y(y);
  message.set_side(side);
  return message;
}

v1::ViewEvent probed(std::uint64_t number, int values = 471) {
  v1::ViewEvent message;
  v1::Probed& to = *message.mutable_probed();
  to.set_number(number);
  to.set_object("ball");
  to.set_material("paint");
  to.mutable_place();
  to.mutable_normal();
  for (int i = 0; i < values; ++i) {
    to.add_eye(i);
    to.add_light(i);
    to.add_surface(0.5);
  }
  return message;
}

TEST_F(ViewTest, AProbeIsOfAPlaceInThePicture) {
  for (const v1::Probe& outside : {place(1, 8, 0), place(1, 0, 6), place(1, ~0u, ~0u)}) {
    const auto refused = view_.probe(outside);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, v1::Error::LIMIT);
  }
  EXPECT_FALSE(view_.probe(place(1, 0, 0, 65)));
  const auto order = view_.probe(place(1, 7, 5, 64));
  ASSERT_TRUE(order && *order);
  EXPECT_EQ((*order)->probe().x(), 7u);
}

TEST_F(ViewTest, OfProbesThatWaitTheOldestGiveWay) {
  ASSERT_TRUE(*view_.probe(place(1, 0, 0)));  // the worker has it
  for (std::uint64_t number = 2; number <= 20; ++number)
    EXPECT_FALSE(*view_.probe(place(number, 0, 0)));
  std::uint64_t at = 1;
  std::vector<std::uint64_t> begun;
  while (at > 0) {
    const auto next = view_.take(probed(at));
    ASSERT_TRUE(next);
    at = *next ? (*next)->probe().number() : 0;
    if (at > 0) begun.push_back(at);
  }
  EXPECT_EQ(begun, (std::vector<std::uint64_t>{14, 15, 16, 17, 18, 19, 20}));
  // A client that does not read them has the newest.
  ASSERT_TRUE(*view_.probe(place(21, 0, 0)));
  ASSERT_TRUE(view_.take(probed(21)));
  EXPECT_EQ(unsent(),
            "updated 0 planned; probed 14; probed 15; probed 16; probed 17; probed 18; probed 19; "
            "probed 20; probed 21; ");
}

TEST_F(ViewTest, AProbesAnswerHasAllItsNumbers) {
  EXPECT_FALSE(view_.take(probed(1))) << "nothing was asked";
  ASSERT_TRUE(view_.probe(place(1, 0, 0)));
  EXPECT_FALSE(view_.take(probed(2))) << "something else was asked";
  for (const int values : {0, 470, 472}) EXPECT_FALSE(view_.take(probed(1, values))) << values;
  const auto is_refused = [&](const std::function<void(v1::Probed&)>& spoil) {
    v1::ViewEvent message = probed(1);
    spoil(*message.mutable_probed());
    return !view_.take(message);
  };
  EXPECT_TRUE(is_refused([](v1::Probed& p) { p.mutable_light()->RemoveLast(); }));
  EXPECT_TRUE(is_refused([](v1::Probed& p) { p.set_eye(3, std::nan("")); }));
  EXPECT_TRUE(is_refused([](v1::Probed& p) { p.clear_object(); }));
  EXPECT_TRUE(is_refused([](v1::Probed& p) { p.clear_material(); }));
  EXPECT_TRUE(is_refused([](v1::Probed& p) { p.clear_place(); }));
  EXPECT_TRUE(is_refused([](v1::Probed& p) { p.mutable_normal()->set_y(HUGE_VAL); }));
  EXPECT_TRUE(is_refused([](v1::Probed& p) { p.add_xyz(1); }));
  EXPECT_TRUE(is_refused([](v1::Probed& p) { p.set_object(std::string(801, 'o')); }));
  EXPECT_FALSE(is_refused([](v1::Probed&) {}));
}

TEST_F(ViewTest, AProbesAnswerMayBeOfNothing) {
  ASSERT_TRUE(view_.probe(place(1, 0, 0)));
  v1::ViewEvent nothing;
  nothing.mutable_probed()->set_number(1);
  EXPECT_TRUE(view_.take(nothing));
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

TEST_F(ViewTest, AnotherSceneLeavesNothingOfTheUpdatesBeforeIt) {
  ASSERT_TRUE(view_.update(light("a", 1, 1)));
  EXPECT_FALSE(*view_.update(light("b", 2, 2)));
  v1::UpdateView another;
  another.set_revision(3);
  another.set_scene_sha256(std::string(32, 's'));
  EXPECT_FALSE(*view_.update(another, std::make_unique<AssetHolds>(*store_)));
  EXPECT_FALSE(*view_.update(light("c", 4, 4)));
  const auto next = view_.take(updated(1, false));
  ASSERT_TRUE(next && *next);
  const v1::UpdateView& merged = (*next)->update_view();
  EXPECT_EQ(merged.view_id(), 7u);
  EXPECT_EQ(merged.revision(), 4u);
  EXPECT_EQ(merged.scene_sha256(), std::string(32, 's'));
  ASSERT_EQ(merged.light_size(), 1);
  EXPECT_EQ(merged.light(0).name(), "c");
}

TEST_F(ViewTest, HoldsTheAssetsOfTheSceneThatIsShown) {
  const auto upload = [&](const std::string& bytes) {
    auto upload = AssetUpload::begin(*store_, {}, sha256(bytes), bytes.size());
    EXPECT_TRUE(upload && upload->add(0, bytes) && upload->commit());
  };
  const auto holding = [&](const std::string& asset) {
    upload(asset);
    auto holds = std::make_unique<AssetHolds>(*store_);
    EXPECT_TRUE(holds->add(sha256(asset)));
    return holds;
  };
  // What nobody holds gives way to what is new.
  char news = 'n';
  const auto is_held = [&](const std::string& asset) {
    for (int i = 0; i < 4; ++i) upload(std::string(300, news++));
    return store_->has(sha256(asset));
  };
  v1::ViewEvent refused;
  refused.mutable_refused();
  v1::UpdateView another;
  another.set_scene_sha256(std::string(32, 's'));
  ASSERT_TRUE(view_.update(another, holding("1")));
  ASSERT_TRUE(view_.update(another, holding("2")));  // waits
  ASSERT_TRUE(view_.take(updated(1, true)));         // the first is shown, the second is sent
  EXPECT_TRUE(is_held("1"));
  EXPECT_TRUE(is_held("2"));
  ASSERT_TRUE(view_.take(refused));
  EXPECT_TRUE(is_held("1"));
  EXPECT_FALSE(is_held("2"));
  ASSERT_TRUE(view_.update(another, holding("3")));
  ASSERT_TRUE(view_.take(updated(2, true)));
  EXPECT_TRUE(is_held("3"));
  EXPECT_FALSE(is_held("1"));
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
TEST(Views, OneThatIsGoneIsNotCounted) {
  const auto folder = TemporaryFolder::make().value();
  const auto store = AssetStore::open(folder.path() / "store", 1000).value();
  Views views(default_limits);
  auto view = views
                  .open(
                      {}, AssetHolds(*store), [] {}, std::make_shared<Account>())
                  .value();
  EXPECT_EQ(views.size(), 1u);
  view.reset();
  EXPECT_EQ(views.size(), 0u);
}

}  // namespace metamer::service
