// How a job ends early: what it refuses, what fails, and who stops it.
#include <sys/mman.h>

#include <algorithm>
#include <thread>

#include "server/worker/job.h"
#include "tests/server/worker/job_fixture.h"

namespace metamer::worker {
namespace {

TEST_F(WorkerJob, StopsInTheMiddleOfACheckAndFailsWhereItsDeviceIsLost) {
  job_.compile(compile_message(ball_scene(std::string(settings) + " verify: true")));
  v1::RenderTiles message = both_tiles();
  message.set_last(true);
  int tiles = 0;
  backend_.before_tile = [&] {
    if (++tiles == 4) job_.stop();
  };
  job_.render(message);
  EXPECT_EQ(sent().back().body_case(), v1::WorkerEnvelope::kStopped);

  Job other(6, options_, link_, work_, turns_);
  tiles = 0;
  backend_.before_tile = [&] {
    if (++tiles == 2) backend_.draw_problem = "the device is lost";
  };
  other.compile(compile_message(ball_scene(std::string(settings) + " verify: true")));
  other.render(message);
  EXPECT_EQ(sent().back().failed().reason(), "the device is lost");
}

TEST_F(WorkerJob, SaysWhatIsWrongWithAScene) {
  job_.compile(
      compile_message(ball_scene(settings, "object { name: 'ball' sphere { radius: 1 } }")));
  const auto messages = sent();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].failed().kind(), v1::Failed::BAD_INPUT);
  ASSERT_GT(messages[0].failed().problem_size(), 0);
  EXPECT_NE(messages[0].failed().problem(0).field().find("object[1]"), std::string::npos);
  EXPECT_TRUE(job_.ended());
}

TEST_F(WorkerJob, TellsASceneFromOtherBytes) {
  v1::CompileJob message;
  message.set_scene_sha256(store("no scene\xff"));
  job_.compile(message);
  const auto messages = sent();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].failed().kind(), v1::Failed::BAD_INPUT);
  EXPECT_EQ(messages[0].failed().reason(), "the scene's bytes are no scene");
  EXPECT_TRUE(damaged_.empty());
}

TEST_F(WorkerJob, NeverTakesBytesThatDoNotHaveTheirDigest) {
  const std::string mesh_bytes =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string lamp_bytes = "400 1\n700 1\n";
  const std::string mesh = store(mesh_bytes), lamp = store(lamp_bytes);
  v1::CompileJob message = compile_message(
      ball_scene(settings,
                 "object { material: 'paint' mesh { file: 'a.ply' } } light { name: 'other' "
                 "position { y: 2 } spectrum { file: 'lamp.csv' } }"));
  for (const auto& [name, digest] : {std::pair("a.ply", mesh), std::pair("lamp.csv", lamp)}) {
    v1::AssetName& asset = *message.add_asset();
    asset.set_name(name);
    asset.set_sha256(digest);
  }
  const auto failed = [&] {
    Job(6, options_, link_, work_, turns_).compile(message);
    return sent().back().failed();
  };
  EXPECT_EQ(failed().reason(), "") << "all is as it should be";
  for (const auto& [digest, name, field] :
       {std::tuple<std::string, std::string, std::string>{mesh, "a.ply", "object[1].mesh.file"},
        {lamp, "lamp.csv", "light[1].spectrum.file"},
        {message.scene_sha256(), "the scene", ""}}) {
    damaged_.clear();
    spoil(digest);
    const v1::Failed failure = failed();
    EXPECT_EQ(failure.kind(), v1::Failed::SERVER) << name;
    EXPECT_EQ(failure.reason(), "the server's file of " + name + " is damaged; send it again");
    ASSERT_FALSE(damaged_.empty());
    EXPECT_EQ(damaged_.back(), digest) << name;
    std::filesystem::remove(options_.store / to_hex(*digest_from_bytes(digest)));
    EXPECT_EQ(failed().kind(), v1::Failed::SERVER) << name << " is not there";
    if (field.empty()) continue;
    ASSERT_GT(failure.problem_size(), 0);
    EXPECT_EQ(failure.problem(0).field(), field);
    EXPECT_EQ(failure.problem(0).message(), "the server's file is damaged; send it again");
    store(name == "a.ply" ? mesh_bytes : lamp_bytes);
    EXPECT_EQ(failed().reason(), "") << name << " has come anew";
  }
}

TEST_F(WorkerJob, RefusesTilesOutsideItsPlan) {
  job_.compile(compile_message(ball_scene(settings)));
  v1::RenderTiles message = both_tiles();
  message.mutable_tile(0)->set_width(17);
  job_.render(message);
  const auto messages = sent();
  EXPECT_EQ(messages.back().failed().kind(), v1::Failed::SERVER);
  EXPECT_EQ(backend_.seen.pictures, 0);
}

TEST_F(WorkerJob, StopsInTheMiddleOfAPicture) {
  job_.compile(compile_message(ball_scene(settings)));
  backend_.before_tile = [&, tiles = 0]() mutable {
    if (tiles++ == 1) job_.stop();
  };
  job_.render(both_tiles());
  EXPECT_EQ(sent_names(), (Names{"planned", "tile_done", "stopped"}));
}

TEST_F(WorkerJob, AStoppedJobIsNotPlanned) {
  job_.stop();
  job_.compile(compile_message(ball_scene(settings)));
  EXPECT_EQ(sent_names(), (Names{"stopped"}));
}

TEST_F(WorkerJob, ARendererThatFailsFailsTheJobWithItsReason) {
  job_.compile(compile_message(ball_scene(settings)));
  backend_.draw_problem = "the device is on fire";
  job_.render(both_tiles());
  backend_.draw_problem.clear();
  backend_.change_problem = "no memory";
  Job other(6, options_, link_, work_, turns_);
  other.compile(compile_message(ball_scene(settings)));
  other.render(both_tiles());
  std::vector<std::string> reasons;
  for (const v1::WorkerEnvelope& message : sent())
    if (message.has_failed()) {
      EXPECT_EQ(message.failed().kind(), v1::Failed::SERVER);
      reasons.push_back(message.failed().reason());
    }
  EXPECT_EQ(reasons, (Names{"the device is on fire", "no memory"}));
}

TEST_F(WorkerJob, RefusesWhatItsBackendDoesNotHave) {
  backend_.features_ = Features::all().without({Feature::factors, Feature::mirrors});
  v1::CompileJob message = compile_message(ball_scene(settings));
  message.set_keep_factors(true);
  job_.compile(message);
  const auto messages = sent();
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0].failed().kind(), v1::Failed::BAD_INPUT);
  EXPECT_EQ(messages[0].failed().reason(), "the fake backend keeps no factors for relighting");
}

TEST_F(WorkerJob, SaysWhichFieldItsBackendHasNot) {
  backend_.features_ = Features::all().without({Feature::exact_fresnel});
  job_.compile(compile_message(ball_scene(
      settings,
      "material { name: 'gold' cook_torrance {} fresnel { conductor { metal: 'Au' } } } object { "
      "name: 'ring' material: 'gold' sphere { radius: 1 } }")));
  const auto messages = sent();
  ASSERT_EQ(messages.size(), 1u);
  ASSERT_EQ(messages[0].failed().problem_size(), 1);
  EXPECT_EQ(messages[0].failed().problem(0).field(), "material[1].fresnel");
}

}  // namespace
}  // namespace metamer::worker
