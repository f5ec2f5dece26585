// Views beside others who want the same worker.
#include <signal.h>

#include "running_job.h"
#include "viewer.h"

namespace metamer::test {
namespace {

using namespace client;

TEST(View, AJobAndViewsOfBothBackendsShareTheirWorkers) {
  const Daemon daemon;
  for (const v1::Backend backend : {v1::CPU, v1::GL}) {
    v1::Scene endless = parsed(endless_scene());
    endless.mutable_settings()->set_backend(backend);
    endless.mutable_settings()->set_spp(16);
    std::string text;
    google::protobuf::TextFormat::PrintToString(endless, &text);
    RunningJob job(daemon, text);
    Viewer viewer(daemon);
    const auto one = viewer.open(direct_scene(), backend);
    const auto other = viewer.open(direct_scene(), backend);
    ASSERT_TRUE(one && other) << viewer.error().message;
    viewer.complete(*one, 0);
    viewer.complete(*other, 0);
    EXPECT_FALSE(job.event("tile").is_null()) << "the job goes on";
    EXPECT_EQ(daemon.metamer({"cancel", job.id()}).code, 0);
  }
}

TEST(View, ASlowClientHoldsUpNobody) {
  const Daemon daemon;
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const auto slow = daemon.start({"view", scene, "--record", "1000", "--rate", "1"});
  ASSERT_TRUE(slow->line_out("scene.txtpb"));
  const Json fast = daemon.json({"view", scene, "--record", "300"});
  EXPECT_EQ(fast["frames"].size(), 300u);
  // Had they had turns with each other, this would have come after the slow one's 300th second.
  slow->signal(SIGINT);
  const Ended ended = slow->wait();
  EXPECT_EQ(ended.code, 5);
  EXPECT_NE(ended.out.find(" frames ("), std::string::npos) << "what was recorded is told";
}

TEST(View, AHeavyOneLeavesTheOthersTheirTurns) {
  const Daemon daemon;
  Viewer viewer(daemon);
  v1::Scene heavy = direct_scene();
  // Minutes for its first frame, and it is closed in the middle of it.
  heavy.mutable_settings()->set_width(2048);
  heavy.mutable_settings()->set_height(2048);
  const v1::Light lamp = heavy.light(0);
  for (int i = 0; i < 200; ++i) {
    *heavy.add_light() = lamp;
    heavy.mutable_light()->rbegin()->set_name("lamp " + std::to_string(i));
  }
  heavy.mutable_settings()->mutable_method()->mutable_point()->set_from(380);
  heavy.mutable_settings()->mutable_method()->mutable_point()->set_to(780);
  heavy.mutable_settings()->mutable_method()->mutable_point()->set_step(0.1);
  const auto big = viewer.open(heavy);
  ASSERT_TRUE(big) << viewer.error().message;
  viewer.ask(*big);
  const auto small = viewer.open(direct_scene());
  ASSERT_TRUE(small);
  viewer.complete(*small, 0);
  viewer.close(*big);
}

/// A floor of so many squares a side.
Upload floor_mesh(int side) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex " + std::to_string((side + 1) * (side + 1)) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
      std::to_string(side * side) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (int z = 0; z <= side; ++z)
    for (int x = 0; x <= side; ++x) text += std::to_string(x) + " 0 " + std::to_string(-z) + "\n";
  for (int z = 0; z < side; ++z)
    for (int x = 0; x < side; ++x) {
      const int at = z * (side + 1) + x;
      text += "4 " + std::to_string(at) + " " + std::to_string(at + 1) + " " +
              std::to_string(at + side + 2) + " " + std::to_string(at + side + 1) + "\n";
    }
  Upload mesh;
  mesh.name = "floor.ply";
  mesh.size = text.size();
  mesh.sha256 = sha256(text);
  mesh.bytes = std::move(text);
  return mesh;
}

/// What reads meshes for its workers.
std::vector<pid_t> importers_of(const Daemon& daemon) {
  std::vector<pid_t> all;
  for (const pid_t worker : children_of(daemon.pid()))
    for (const pid_t one : children_of(worker)) all.push_back(one);
  return all;
}

TEST(View, OthersGetFramesWhileASceneIsImported) {
  const Daemon daemon;
  const Upload mesh = floor_mesh(400);
  v1::Scene heavy = direct_scene();
  heavy.mutable_object(0)->mutable_mesh()->set_file(mesh.name);
  for (const v1::Backend backend : {v1::CPU, v1::GL}) {
    Viewer viewer(daemon);
    const auto light = viewer.open(direct_scene(), backend);
    ASSERT_TRUE(light) << viewer.error().message;
    // The second time nothing is uploaded, and all that is waited for is the import, which stands
    // still until there were some frames.
    for (const bool uploaded : {false, true}) {
      constexpr int frames_meanwhile = 10;
      std::optional<HeldWorkers> importers;
      if (uploaded) importers.emplace(importers_of(daemon));
      std::unique_ptr<View> view;
      bool ended = false;
      viewer.begin_open(heavy, mesh, backend, view, ended);
      int frames = 0;
      for (std::uint64_t revision = 1; !ended; ++revision) {
        v1::UpdateView change;
        change.set_revision(revision);
        *change.mutable_camera() = heavy.camera();
        viewer.update(*light, change);
        viewer.ask(*light);
        ASSERT_TRUE(viewer.next(*light)) << viewer.error().message;
        if (++frames == frames_meanwhile) importers.reset();
      }
      ASSERT_TRUE(view) << viewer.error().message;
      EXPECT_GE(frames, uploaded ? frames_meanwhile : 1);
      viewer.close(*view);
    }
  }
}

TEST(View, OneWhoseClientGoesWhileItIsImportedLeavesTheOthersAlone) {
  const Daemon daemon;
  const Folder folder;
  v1::Scene heavy = direct_scene();
  folder.write("floor.ply", floor_mesh(400).bytes);
  heavy.mutable_object(0)->mutable_mesh()->set_file("floor.ply");
  std::string text;
  google::protobuf::TextFormat::PrintToString(heavy, &text);
  const std::string scene = folder.write("heavy.txtpb", text);
  Viewer viewer(daemon);
  for (int i = 0; i < 3; ++i) {
    const auto client = daemon.start({"view", scene});
    const auto light = viewer.open(direct_scene());
    ASSERT_TRUE(light) << viewer.error().message;
    viewer.complete(*light, 0);
    client->signal(SIGKILL);
    viewer.close(*light);
  }
  EXPECT_EQ(daemon.json({"info"})["info"]["worker"][2]["starts"], 1) << "the worker lives";
}

TEST(View, EndsWithItsWorkerAndCanBeOpenedAgain) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(direct_scene());
  ASSERT_TRUE(view);
  viewer.complete(*view, 0);
  ::kill(daemon.views_worker_pid(), SIGKILL);
  EXPECT_FALSE(viewer.next(*view));
  EXPECT_EQ(viewer.error().message, "the worker was lost: killed by signal 9 (Killed)");
  const auto again = viewer.open(direct_scene());
  ASSERT_TRUE(again) << viewer.error().message;
  viewer.complete(*again, 0);
}

TEST(View, WhatAJobDoesToItsWorkerLeavesViewsAloneAndTheReverse) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(direct_scene());
  ASSERT_TRUE(view);
  viewer.complete(*view, 0);
  RunningJob job(daemon, endless_scene());
  ASSERT_NE(daemon.worker_pid(), daemon.views_worker_pid());
  ::kill(daemon.worker_pid(), SIGKILL);
  EXPECT_FALSE(job.event("retrying").is_null());
  v1::UpdateView change;
  change.set_revision(1);
  *change.mutable_camera() = direct_scene().camera();
  viewer.update(*view, change);
  viewer.complete(*view, 1);
  EXPECT_FALSE(job.event("tile").is_null());
  ::kill(daemon.views_worker_pid(), SIGKILL);
  viewer.ask(*view);
  EXPECT_FALSE(viewer.next(*view));
  EXPECT_EQ(daemon.job_state(job.id()), "running");
  EXPECT_EQ(daemon.json({"info"})["info"]["worker"][0]["starts"], 2);
}

TEST(View, AClientHasAtMostFour) {
  const Daemon daemon;
  Viewer viewer(daemon);
  std::vector<std::unique_ptr<View>> views;
  for (int i = 0; i < 4; ++i) {
    views.push_back(viewer.open(direct_scene()));
    ASSERT_TRUE(views.back()) << viewer.error().message;
  }
  EXPECT_FALSE(viewer.open(direct_scene()));
  EXPECT_EQ(viewer.error().message, "a client may have 4 views open at a time");
  viewer.close(*views[1]);
  EXPECT_TRUE(viewer.open(direct_scene()));
}

TEST(View, AThirdFrameBeforeTheFirstIsRefused) {
  const Daemon daemon;
  Viewer viewer(daemon);
  const auto view = viewer.open(direct_scene());
  ASSERT_TRUE(view);
  viewer.complete(*view, 0);
  for (int i = 0; i < 3; ++i) viewer.ask(*view);
  EXPECT_FALSE(viewer.next(*view));
  EXPECT_EQ(viewer.error().message, "a view has at most 2 frames coming");
}

}  // namespace
}  // namespace metamer::test
