#include "server/worker/view_scene.h"

#include <future>

#include "tests/server/test_scene.h"
#include "tests/server/worker/worker_fixture.h"

namespace metamer::worker {
namespace {

using Change = ViewScene::Change;

class WorkerViewScene : public WorkerTest {
 protected:
  /// Opens a scene and takes what was imported.
  void open(const std::string& text) {
    ASSERT_TRUE(scene_.open(test::parse_scene(text), {}).empty());
    adopt();
  }
  void adopt() {
    imported_.get_future().wait();
    imported_ = {};
    ASSERT_TRUE(scene_.is_imported());
    auto imported = scene_.end_import();
    ASSERT_TRUE(imported) << imported.error().front().message;
    scene_.adopt(std::move(*imported));
  }
  static v1::UpdateView update(const std::string& scene_text) {
    const v1::Scene scene = test::parse_scene(scene_text);
    v1::UpdateView update;
    if (scene.has_camera()) *update.mutable_camera() = scene.camera();
    if (scene.has_settings()) *update.mutable_settings() = scene.settings();
    *update.mutable_light() = scene.light();
    *update.mutable_material() = scene.material();
    return update;
  }
  std::string problem_of(const std::string& change) {
    const auto changed = scene_.change(update(change));
    return changed ? "none"
                   : changed.error().front().field + ": " + changed.error().front().message;
  }

  std::promise<void> imported_;
  ViewScene scene_{options_, [this] { imported_.set_value(); }};
};

TEST_F(WorkerViewScene, ImportsASceneAndItsRenderer) {
  open(ball_scene("width: 8 height: 8"));
  EXPECT_EQ(scene_.scene().objects.size(), 1u);
  EXPECT_EQ(scene_.settings().width(), 8u);
  EXPECT_EQ(scene_.settings().spp(), 16u);  // a default
  EXPECT_EQ(backend_.seen.prepared, 1);
}

TEST_F(WorkerViewScene, AGoalIsShownByTheExactMethod) {
  for (const std::string goal : {"goal { deadline: 1 }", "method { auto {} }"}) {
    open(ball_scene("width: 8 height: 8 " + goal));
    EXPECT_TRUE(scene_.settings().method().has_exact()) << goal;
    EXPECT_FALSE(scene_.settings().has_goal()) << goal;
  }
  EXPECT_NE(problem_of("settings { goal {} method { rgb {} } }").find("not both"),
            std::string::npos);
}

TEST_F(WorkerViewScene, ACameraLeavesEverythingElse) {
  open(ball_scene("width: 8 height: 8"));
  const RenderScene* before = &scene_.scene();
  const Eigen::Vector3d eye = before->camera.eye;
  EXPECT_EQ(*scene_.change(update("camera { eye { x: 1 z: 3 } target {} }")), Change::camera);
  EXPECT_EQ(&scene_.scene(), before);
  EXPECT_NE(scene_.scene().camera.eye, eye);
  EXPECT_EQ(backend_.seen.renderers, 1);
}

TEST_F(WorkerViewScene, ACameraFarAwayWantsTheSceneAroundItself) {
  open(ball_scene("width: 8 height: 8"));
  EXPECT_EQ(*scene_.change(update("camera { eye { z: 1e6 } target {} }")), Change::objects);
  adopt();
  EXPECT_LT(scene_.scene().camera.eye.norm(), 1e-9);
  EXPECT_EQ(backend_.seen.renderers, 2);
}

TEST_F(WorkerViewScene, LightsAndPaintsLeaveTheObjects) {
  open(ball_scene("width: 8 height: 8"));
  EXPECT_EQ(*scene_.change(update("light { name: 'lamp' position { x: 5 } luminance: 3 spectrum { "
                                  "standard: 'A' } }")),
            Change::appearance);
  EXPECT_EQ(scene_.scene().lights[0].luminance, 3);
  EXPECT_EQ(
      *scene_.change(update("material { name: 'paint' diffuse { constant: 0.2 } lambert {} }")),
      Change::appearance);
  EXPECT_EQ(*scene_.change(update("settings { width: 4 height: 2 }")), Change::appearance);
  EXPECT_EQ(scene_.settings().width(), 4u);
  EXPECT_EQ(scene_.scene().objects.size(), 1u);
  EXPECT_EQ(backend_.seen.renderers, 1);
}

TEST_F(WorkerViewScene, APaintThatLooksAtTangentsWantsOtherObjects) {
  open(ball_scene("width: 8 height: 8"));
  EXPECT_EQ(*scene_.change(update("material { name: 'paint' cook_torrance {} specularness: 1 slope "
                                  "{ ward { roughness_u: 0.1 roughness_v: 0.4 } } }")),
            Change::objects);
  EXPECT_TRUE(scene_.is_importing());
  EXPECT_EQ(scene_.scene().materials[0].name, "paint");
  EXPECT_FALSE(scene_.scene().materials[0].anisotropic());  // until it is adopted
  adopt();
  EXPECT_TRUE(scene_.scene().materials[0].anisotropic());
}

TEST_F(WorkerViewScene, WhatIsRefusedChangesNothing) {
  open(ball_scene("width: 8 height: 8"));
  const std::string before = scene_.scene().lights[0].name;
  EXPECT_EQ(problem_of("light { name: 'sun' position {} }"),
            "light[0].name: the scene has no light named \"sun\"");
  EXPECT_EQ(problem_of("settings { width: 100000 height: 100000 }").rfind("settings.width: ", 0),
            0u);
  EXPECT_NE(problem_of("light { name: 'lamp' position {} spectrum { standard: 'D99' } }"), "none");
  EXPECT_NE(problem_of("camera { eye {} target {} }"), "none");
  EXPECT_EQ(scene_.settings().width(), 8u);
  EXPECT_EQ(scene_.scene().lights[0].name, before);
  EXPECT_FALSE(scene_.is_importing());
}

TEST_F(WorkerViewScene, IsRefusedAtOnceWhereItIsTooLarge) {
  const auto problems =
      scene_.open(test::parse_scene(ball_scene("width: 100000 height: 100000")), {});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].field, "settings.width");
  EXPECT_FALSE(scene_.is_importing());
}

TEST_F(WorkerViewScene, AnImportSaysWhatIsWrong) {
  ASSERT_TRUE(
      scene_.open(test::parse_scene(ball_scene("", "object { name: 'ball' }")), {}).empty());
  imported_.get_future().wait();
  const auto imported = scene_.end_import();
  ASSERT_FALSE(imported);
  EXPECT_FALSE(imported.error().empty());
}

}  // namespace
}  // namespace metamer::worker
