#include "server/worker/view.h"

#include <future>
#include <thread>

#include "tests/server/worker/worker_fixture.h"

namespace metamer::worker {
namespace {

class WorkerView : public WorkerTest {
 protected:
  bool open(const std::string& text) {
    v1::OpenView message;
    message.set_scene_sha256(store_scene(text));
    if (!view_.open(message)) return false;
    imported_.get_future().wait();
    return view_.turn();
  }
  v1::UpdateView look_from(double x, std::uint64_t revision) const {
    v1::UpdateView update;
    update.set_revision(revision);
    update.mutable_camera()->mutable_eye()->set_x(x);
    update.mutable_camera()->mutable_eye()->set_z(3);
    update.mutable_camera()->mutable_target();
    return update;
  }
  /// The last band's, which every frame of these tests is alone.
  v1::Frame last_frame() { return sent().back().view_event().band().frame(); }

  std::promise<void> imported_;
  View view_{3, options_, link_, work_, [this] { imported_.set_value(); }};
};

TEST_F(WorkerView, SaysItsPlanAndDrawsAFrameForEachCredit) {
  ASSERT_TRUE(open(ball_scene(small)));
  EXPECT_FALSE(view_.has_work());  // nobody has asked for a frame
  view_.add_credit();
  view_.add_credit();
  int turns = 0;
  for (; view_.has_work(); ++turns) ASSERT_TRUE(view_.turn());
  EXPECT_EQ(turns, 2);
  EXPECT_EQ(sent_names(), (Names{"view_event.updated", "view_event.band", "view_event.band"}));
  EXPECT_EQ(backend_.seen.pictures, 2);
  EXPECT_EQ(backend_.seen.samples.size(), 1u);  // a frame adds one sample of each pixel
}

TEST_F(WorkerView, IsCompleteOnceAllSamplesAreDrawn) {
  ASSERT_TRUE(open(ball_scene(small)));
  v1::Frame last;
  for (int i = 0; i < 10; ++i) view_.add_credit();
  // The first frame of a machine whose speed is not known is coarse.
  while (view_.has_work()) {
    ASSERT_TRUE(view_.turn());
    last = last_frame();
  }
  EXPECT_TRUE(last.complete());
  EXPECT_EQ(last.samples(), 4u);
}

TEST_F(WorkerView, ACameraBeginsAnewAndPreparesNothing) {
  ASSERT_TRUE(open(ball_scene(small)));
  view_.add_credit();
  while (view_.has_work()) ASSERT_TRUE(view_.turn());
  const int changes = backend_.seen.changes;
  view_.update(look_from(1, 9));
  view_.add_credit();
  while (view_.has_work()) ASSERT_TRUE(view_.turn());
  const v1::Frame frame = last_frame();
  EXPECT_EQ(frame.revision(), 9u);
  EXPECT_EQ(frame.samples(), 1u);
  EXPECT_EQ(backend_.seen.changes, changes);
}

TEST_F(WorkerView, SaysWhatAChangeTook) {
  ASSERT_TRUE(open(ball_scene(small)));
  view_.update(look_from(1, 2));
  ASSERT_TRUE(view_.turn());
  const auto messages = sent();
  ASSERT_EQ(messages.size(), 2u);
  for (const v1::WorkerEnvelope& message : messages) {
    const v1::ViewUpdated& updated = message.view_event().updated();
    ASSERT_TRUE(updated.has_timing());
    const v1::Timing& timing = updated.timing();
    EXPECT_GT(timing.compile(), 0);
    EXPECT_LE(timing.compile() + timing.acceleration() + timing.prepare(), updated.seconds());
  }
  EXPECT_GT(messages[0].view_event().updated().timing().prepare(), 0);
  EXPECT_EQ(messages[1].view_event().updated().timing().prepare(), 0) << "a camera alone";
}

TEST_F(WorkerView, AFrameThatTakesLongIsDrawnInTurns) {
  ASSERT_TRUE(open(ball_scene(small)));
  view_.add_credit();
  while (view_.has_work()) ASSERT_TRUE(view_.turn());  // the coarse one
  sent();
  backend_.before_tile = [] { std::this_thread::sleep_for(turn_time * 1.1); };
  view_.add_credit();
  ASSERT_TRUE(view_.turn());
  EXPECT_TRUE(sent().empty());
  // The first frame of a revision is drawn to its end, whatever comes meanwhile.
  view_.update(look_from(1, 2));
  for (int row = 1; row < 4; ++row) ASSERT_TRUE(view_.turn());
  EXPECT_EQ(sent_names(), (Names{"view_event.band"}));
  ASSERT_TRUE(view_.turn());
  EXPECT_EQ(sent_names(), (Names{"view_event.updated"}));
}

TEST_F(WorkerView, RefusesWhatIsWrongAndGoesOn) {
  ASSERT_TRUE(open(ball_scene(small)));
  sent();
  v1::UpdateView update;
  update.set_revision(4);
  update.add_light()->set_name("sun");
  view_.update(update);
  ASSERT_TRUE(view_.turn());
  view_.add_credit();
  ASSERT_TRUE(view_.turn());
  EXPECT_EQ(sent_names(), (Names{"view_event.refused", "view_event.band"}));
}

TEST_F(WorkerView, ClosesWhereTheSceneIsBad) {
  EXPECT_FALSE(open(ball_scene(small, "object { name: 'ball' }")));
  const auto messages = sent();
  ASSERT_EQ(messages.size(), 1u);
  const v1::Failed& reason = messages[0].view_event().closed().reason();
  EXPECT_EQ(reason.kind(), v1::Failed::BAD_INPUT);
  EXPECT_GT(reason.problem_size(), 0);
}

TEST_F(WorkerView, SaysWhichFileOfTheServersIsDamaged) {
  const std::string scene = store_scene(ball_scene(small));
  ASSERT_TRUE(open(ball_scene(small)));
  sent();
  const std::string other = store_scene(ball_scene("width: 4 height: 4"));
  spoil(other);
  v1::UpdateView update;
  update.set_scene_sha256(other);
  view_.update(update);
  ASSERT_TRUE(view_.turn());
  EXPECT_EQ(sent_names(), (Names{"view_event.refused"})) << "it goes on with what it has";
  EXPECT_EQ(damaged_, Names{other});

  spoil(scene);
  v1::OpenView message;
  message.set_scene_sha256(scene);
  EXPECT_FALSE(View(4, options_, link_, work_, [] {}).open(message));
  const v1::Failed reason = sent().back().view_event().closed().reason();
  EXPECT_EQ(reason.kind(), v1::Failed::SERVER);
  EXPECT_EQ(reason.reason(), "the server's file of the scene is damaged; send it again");
}

TEST_F(WorkerView, ClosesWhereTheRendererFails) {
  ASSERT_TRUE(open(ball_scene(small)));
  view_.add_credit();
  backend_.draw_problem = "the device is on fire";
  sent();
  EXPECT_FALSE(view_.turn());
  EXPECT_EQ(sent().back().view_event().closed().reason().reason(), "the device is on fire");
}

}  // namespace
}  // namespace metamer::worker
