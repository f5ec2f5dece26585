#include "server/worker/view_probe.h"

#include <cstring>
#include <future>

#include "server/film/develop.h"
#include "server/worker/view.h"
#include "tests/server/worker/worker_fixture.h"

namespace metamer::worker {
namespace {

v1::Probe place(std::uint32_t x, std::uint32_t y, std::uint32_t side = 0) {
  v1::Probe probe;
  probe.set_number(6);
  probe.set_x(x);
  probe.set_y(y);
  probe.set_side(side);
  return probe;
}

/// A picture of 6 by 4 pixels whose X and Y are a pixel's place.
class MeanOf : public testing::Test {
 protected:
  MeanOf() {
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 6; ++x)
        for (const int value : {2 * x, 2 * y, 2}) sums_.push_back(static_cast<float>(value));
  }
  Xyz mean(const v1::Probe& probe, std::uint32_t part = 1) const {
    return mean_of({6, 4, part, sums_, 0.5f}, probe);
  }
  std::vector<float> sums_;
};

TEST_F(MeanOf, IsThePixelItself) {
  EXPECT_EQ(mean(place(5, 3)), (Xyz{5, 3, 1}));
  EXPECT_EQ(mean(place(0, 0, 1)), (Xyz{0, 0, 1}));
}

TEST_F(MeanOf, IsThatOfTheSquareAroundIt) {
  EXPECT_EQ(mean(place(2, 1, 3)), (Xyz{2, 1, 1}));
  EXPECT_EQ(mean(place(2, 1, 2)), (Xyz{2.5, 1.5, 1})) << "an even one reaches right and down";
}

TEST_F(MeanOf, LeavesOutWhatLiesBesideThePicture) {
  EXPECT_EQ(mean(place(0, 0, 3)), (Xyz{0.5, 0.5, 1}));
  EXPECT_EQ(mean(place(5, 3, 5)), (Xyz{4, 2, 1}));
  EXPECT_EQ(mean(place(3, 2, 64)), (Xyz{2.5, 1.5, 1}));
}

TEST_F(MeanOf, OfACoarseFrameIsThatOfThePixelsThatStandForTheSquares) {
  EXPECT_EQ(mean(place(7, 8), 4), (Xyz{1, 2, 1}));
  EXPECT_EQ(mean(place(7, 8, 3), 4), (Xyz{1.5, 1.5, 1}));
  EXPECT_EQ(mean(place(22, 15, 9), 4), (Xyz{4.5, 2.5, 1}));
}

class WorkerViewProbe : public WorkerTest {
 protected:
  void open() {
    v1::OpenView message;
    message.set_scene_sha256(store_scene(ball_scene(small)));
    ASSERT_TRUE(view_.open(message));
    imported_.get_future().wait();
    ASSERT_TRUE(view_.turn());
  }
  void draw(bool xyz) {
    view_.add_credit(xyz);
    while (view_.has_work()) ASSERT_TRUE(view_.turn());
  }
  v1::Probed probe(std::uint32_t x, std::uint32_t y) {
    sent();
    view_.probe(place(x, y));
    EXPECT_TRUE(view_.has_work());
    EXPECT_TRUE(view_.turn());
    return sent().back().view_event().probed();
  }

  std::promise<void> imported_;
  View view_{3, options_, link_, work_, [this] { imported_.set_value(); }};
};

TEST_F(WorkerViewProbe, SaysWhatTheRendererSees) {
  open();
  const v1::Probed ball = probe(7, 0);
  EXPECT_EQ(ball.number(), 6u);
  EXPECT_EQ(ball.object(), "ball");
  EXPECT_EQ(ball.material(), "paint");
  EXPECT_EQ(ball.normal().z(), 1);
  EXPECT_EQ(ball.light_size(), 471);
  EXPECT_EQ(ball.xyz_size(), 0) << "nothing was drawn yet";
  EXPECT_TRUE(probe(0, 0).object().empty());
  EXPECT_TRUE(probe(99, 0).object().empty()) << "the picture has become smaller meanwhile";
}

TEST_F(WorkerViewProbe, XyzAreThoseOfTheNewestFrameOfThisRevision) {
  open();
  for (int frame = 0; frame < 5; ++frame) draw(false);
  EXPECT_EQ(probe(7, 3).xyz(0), 7);
  v1::UpdateView update;
  update.set_revision(9);
  update.mutable_camera()->mutable_eye()->set_z(4);
  update.mutable_camera()->mutable_target();
  view_.update(update);
  const v1::Probed after = probe(7, 3);
  EXPECT_EQ(after.revision(), 9u);
  EXPECT_EQ(after.xyz_size(), 0);
}

TEST_F(WorkerViewProbe, ACompleteFrameHasTheXyzThatItsColoursAreMadeOf) {
  open();
  const v1::Plan plan = sent().back().view_event().updated().plan();
  v1::FrameBand band;
  for (int frame = 0; frame < 10 && !band.frame().complete(); ++frame) {
    draw(true);
    band = sent().back().view_event().band();
    EXPECT_EQ(band.xyz().size(), band.frame().complete() ? band.rgb().size() * 4 : 0);
  }
  std::vector<float> xyz(band.xyz().size() / 4);
  std::memcpy(xyz.data(), band.xyz().data(), band.xyz().size());
  std::vector<std::uint8_t> rgb(xyz.size());
  Developer::make(plan)->develop(xyz, 1, rgb);
  EXPECT_EQ(std::string(rgb.begin(), rgb.end()), band.rgb());
  EXPECT_EQ(xyz[(3 * 8 + 5) * 3], 5);
  EXPECT_EQ(xyz[(3 * 8 + 5) * 3 + 1], 3);
}

TEST_F(WorkerViewProbe, XyzThatAreWantedOnceTheFrameIsCompleteComeWithItAgain) {
  open();
  for (int frame = 0; frame < 5; ++frame) draw(false);
  ASSERT_TRUE(sent().back().view_event().band().frame().complete());
  view_.add_credit(false);
  EXPECT_FALSE(view_.has_work()) << "there is nothing new to see";
  draw(true);
  // Frames come as they were asked for.
  const auto messages = sent();
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_TRUE(messages[0].view_event().band().xyz().empty());
  EXPECT_EQ(messages[1].view_event().band().xyz().size(), 8 * 4 * 3 * 4u);
  EXPECT_TRUE(messages[1].view_event().band().frame().complete());
  view_.add_credit(true);
  EXPECT_FALSE(view_.has_work()) << "they were sent";
}

}  // namespace
}  // namespace metamer::worker
