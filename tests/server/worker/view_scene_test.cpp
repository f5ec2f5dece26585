#include "server/worker/view_scene.h"

#include <filesystem>
#include <future>

#include "common/digest.h"
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
  v1::UpdateView replacement(const v1::Scene& scene) const {
    v1::UpdateView update;
    update.set_scene_sha256(store(scene.SerializeAsString()));
    return update;
  }
  v1::UpdateView replacement(const std::string& scene_text) const {
    return replacement(test::parse_scene(scene_text));
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

TEST_F(WorkerViewScene, AnObjectThatBeginsToShineIsMeasuredOnce) {
  open(
      "camera { eye { z: 3 } target {} } light { name: 'lamp' position { z: 4 } spectrum { "
      "standard: 'A' } } material { name: 'm' } object { name: 'card' material: 'm' quad { u { x: "
      "1 "
      "} v { y: 2 } } } settings { width: 8 height: 8 }");
  EXPECT_EQ(scene_.scene().objects[0].area_up_to, nullptr);
  const std::string shining = "light { name: 'lamp' object: 'card' spectrum { standard: 'A' } ";
  EXPECT_EQ(*scene_.change(update(shining + "}")), Change::appearance);
  const auto measured = scene_.scene().objects[0].area_up_to;
  ASSERT_NE(measured, nullptr);
  EXPECT_EQ(*measured, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(*scene_.change(update(shining + "luminance: 2 }")), Change::appearance);
  EXPECT_EQ(scene_.scene().objects[0].area_up_to, measured);
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

TEST_F(WorkerViewScene, AnotherSceneWithTheSameObjectsLeavesThese) {
  open(ball_scene("width: 8 height: 8"));
  // Another list of lights and of materials; what comes with it is applied to the new scene.
  v1::UpdateView change = replacement(
      ball_scene("width: 4 height: 2",
                 "light { name: 'sun' direction { y: -1 } spectrum { standard: 'A' } } material { "
                 "name: 'more' lambert {} }"));
  *change.add_light() = test::parse_scene(ball_scene("")).light(0);
  change.mutable_light(0)->set_luminance(3);
  EXPECT_EQ(*scene_.change(change), Change::appearance);
  EXPECT_EQ(scene_.scene().lights.size(), 2u);
  EXPECT_EQ(scene_.scene().lights[0].luminance, 3);
  EXPECT_EQ(scene_.scene().materials.size(), 2u);
  EXPECT_EQ(scene_.scene().objects.size(), 1u);
  EXPECT_EQ(scene_.settings().width(), 4u);
  EXPECT_EQ(scene_.settings().spp(), 16u);  // a default, not what was before
  EXPECT_EQ(backend_.seen.renderers, 1);
}

TEST_F(WorkerViewScene, AnotherMaterialBeforeThatOfAnObjectIsAnotherPlaceOfIt) {
  open(ball_scene("width: 8 height: 8"));
  v1::Scene scene =
      test::parse_scene(ball_scene("width: 8 height: 8", "material { name: 'more' }"));
  scene.mutable_material()->SwapElements(0, 1);
  EXPECT_EQ(*scene_.change(replacement(scene)), Change::objects);
  adopt();
  EXPECT_EQ(scene_.scene().materials[scene_.scene().objects[0].material].name, "paint");
}

const char* const triangle =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 "
    "0 "
    "1 2\n";

TEST_F(WorkerViewScene, MeshesOfAnotherSceneAreReadOnlyWhereTheyAreOthers) {
  const auto names = [](const std::string& digest) {
    AssetNames list;
    list.Add()->set_name("a.ply");
    list[0].set_sha256(digest);
    return list;
  };
  const std::string digest = store(triangle);
  const std::string with_mesh =
      ball_scene("width: 8 height: 8", "object { material: 'paint' mesh { file: 'a.ply' } }");
  ASSERT_TRUE(scene_.open(test::parse_scene(with_mesh), names(digest)).empty());
  adopt();
  const Triangle* const before = scene_.scene().meshes[0].triangles.data();

  // The file is gone: whoever reads it again has a problem.
  std::filesystem::remove(options_.store / to_hex(*digest_from_bytes(digest)));
  v1::Scene moved = test::parse_scene(with_mesh);
  moved.mutable_object(1)->add_transform()->mutable_translate()->set_x(1);
  v1::UpdateView change = replacement(moved);
  *change.mutable_asset() = names(digest);
  ASSERT_EQ(*scene_.change(change), Change::objects);
  adopt();
  EXPECT_EQ(scene_.scene().meshes[0].triangles.data(), before);
  EXPECT_EQ(backend_.seen.renderers, 2);

  // Under the same name another one.
  *change.mutable_asset() = names(store(std::string(triangle) + "\n"));
  ASSERT_EQ(*scene_.change(change), Change::objects);
  adopt();
  EXPECT_NE(scene_.scene().meshes[0].triangles.data(), before);
}

TEST_F(WorkerViewScene, AnotherSceneThatIsBadChangesNothing) {
  open(ball_scene("width: 8 height: 8"));
  const auto refused = [&](const v1::UpdateView& change) {
    const auto changed = scene_.change(change);
    return changed ? "none"
                   : changed.error().front().field + ": " + changed.error().front().message;
  };
  v1::UpdateView change;
  change.set_scene_sha256(store("no scene"));
  EXPECT_EQ(refused(change), ": the scene's bytes are no scene");
  change.set_scene_sha256(std::string(32, 'x'));
  EXPECT_EQ(refused(change), ": the server's file is damaged; send it again");
  EXPECT_EQ(refused(replacement(ball_scene("width: 100000 height: 100000"))).rfind("settings.", 0),
            0u);
  EXPECT_NE(refused(replacement(ball_scene("", "object { name: 'ball' }"))), "none");
  // What is found out as late as in the import.
  const std::string no_mesh = "object { material: 'paint' mesh { file: 'none.ply' } }";
  ASSERT_EQ(*scene_.change(replacement(ball_scene("", no_mesh))), Change::objects);
  imported_.get_future().wait();
  imported_ = {};
  EXPECT_FALSE(scene_.end_import());
  EXPECT_EQ(scene_.scene().objects.size(), 1u);
  EXPECT_EQ(scene_.settings().width(), 8u);
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
