#include "server/worker/job.h"

#include <sys/mman.h>

#include <algorithm>
#include <thread>

#include "tests/server/worker/worker_fixture.h"

namespace metamer::worker {
namespace {

/// Views that want a turn as often as they are told to.
class FakeTurns : public ViewTurns {
 public:
  bool waiting() const override { return waiting_; }
  void serve() override { ++served_; }
  void serve_while(const std::function<void()>& work) override { work(); }

  std::atomic<bool> waiting_ = false;
  int served_ = 0;
};

class WorkerJob : public WorkerTest {
 protected:
  v1::CompileJob compile_message(const std::string& scene_text) const {
    v1::CompileJob message;
    message.set_scene_sha256(store_scene(scene_text));
    return message;
  }
  /// The picture of 32 by 16 pixels in two tiles.
  static v1::RenderTiles both_tiles() {
    v1::RenderTiles message;
    for (const std::uint32_t x : {16u, 0u}) {
      v1::TileRect& tile = *message.add_tile();
      tile.set_x(x);
      tile.set_width(16);
      tile.set_height(16);
    }
    return message;
  }
  static constexpr const char* settings = "width: 32 height: 16 spp: 4";

  FakeTurns turns_;
  Job job_{5, options_, link_, work_, turns_};
};

TEST_F(WorkerJob, SendsItsPlanThenEachTileInTheOrderAskedForThenDone) {
  job_.compile(compile_message(ball_scene(settings)));
  const auto planned = sent();
  ASSERT_EQ(planned.size(), 1u);
  EXPECT_EQ(planned[0].job_id(), 5u);
  EXPECT_EQ(planned[0].planned().plan().width(), 32u);
  EXPECT_FALSE(job_.ended());

  job_.render(both_tiles());
  const auto messages = sent();
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[0].tile_done().tile().x(), 16u);
  EXPECT_EQ(messages[1].tile_done().tile().x(), 0u);
  EXPECT_EQ(messages[1].tile_done().rays(), 7u);
  EXPECT_EQ(messages[2].done().timing().models(), 0.25);
  EXPECT_TRUE(job_.ended());
  EXPECT_EQ(backend_.seen.samples.size(), 4u);

  const void* memory =
      mmap(nullptr, 64 * 64 * 12, PROT_READ, MAP_SHARED, options_.film_descriptor, 0);
  const float* xyz = static_cast<const float*>(memory);
  EXPECT_EQ(xyz[(3 * 32 + 20) * 3], 20);
  EXPECT_EQ(xyz[(3 * 32 + 20) * 3 + 1], 3);
}

TEST_F(WorkerJob, SaysEachStageAsItBeginsAndOnceWhatTheyTook) {
  const auto names = [&] {
    sent();
    Names told;
    for (const v1::WorkerEnvelope& stage : stages_)
      told.push_back(stage.has_prepared() ? std::string("prepared")
                                          : v1::Preparing::Stage_Name(stage.preparing().stage()));
    return told;
  };
  job_.compile(compile_message(ball_scene(settings)));
  EXPECT_EQ(names(), (Names{"READING", "PLANNING", "TABLES"}));
  job_.render(both_tiles());
  job_.render(both_tiles());
  EXPECT_EQ(names(), (Names{"READING", "PLANNING", "TABLES", "HIERARCHY", "prepared"}));
  const v1::Timing timing = stages_.back().prepared().timing();
  EXPECT_GT(timing.compile(), 0);
  EXPECT_EQ(timing.models(), 0) << "nothing is drawn yet";

  // A choice traces pixels, and so has the hierarchy first.
  stages_.clear();
  Job chosen(6, options_, link_, work_, turns_);
  chosen.compile(
      compile_message(ball_scene(std::string(settings) + " verify: true goal { tolerance: 0.5 }")));
  v1::RenderTiles message = both_tiles();
  message.set_last(true);
  chosen.render(message);
  chosen.render(message);
  const Names told = names();
  ASSERT_GE(told.size(), 4u);
  EXPECT_EQ(Names(told.begin(), told.begin() + 3), (Names{"READING", "HIERARCHY", "PLANNING"}));
  EXPECT_EQ(told.back(), "prepared");
  EXPECT_EQ(std::count(told.begin(), told.end(), "prepared"), 1);
  EXPECT_EQ(std::count(told.begin(), told.end(), "HIERARCHY"), 1);
}

TEST_F(WorkerJob, PreparesWithoutDrawingWhereThatIsAskedFor) {
  v1::CompileJob message = compile_message(ball_scene(settings));
  message.set_prepare(true);
  job_.compile(message);
  EXPECT_EQ(sent_names(), (Names{"planned"}));
  ASSERT_FALSE(stages_.empty());
  EXPECT_TRUE(stages_.back().has_prepared());
  EXPECT_EQ(backend_.seen.changes, 1);
  EXPECT_EQ(backend_.seen.pictures, 0);
  EXPECT_FALSE(job_.ended());

  backend_.change_problem = "no memory";
  Job failing(6, options_, link_, work_, turns_);
  failing.compile(message);
  const auto messages = sent();
  EXPECT_EQ(messages.back().failed().reason(), "no memory");
  EXPECT_TRUE(failing.ended());
}

TEST_F(WorkerJob, PreparesOnceHoweverOftenItIsAskedForTiles) {
  job_.compile(compile_message(ball_scene(settings)));
  job_.render(both_tiles());
  job_.render(both_tiles());
  EXPECT_EQ(sent_names(),
            (Names{"planned", "tile_done", "tile_done", "done", "tile_done", "tile_done", "done"}));
  EXPECT_EQ(backend_.seen.renderers, 1);
  EXPECT_EQ(backend_.seen.prepared, 1);
  EXPECT_EQ(backend_.seen.changes, 1);
  EXPECT_EQ(backend_.seen.pictures, 2);
}

TEST_F(WorkerJob, DrawsNothingWhereNoTilesAreMissing) {
  job_.compile(compile_message(ball_scene(settings)));
  job_.render({});
  EXPECT_EQ(sent_names(), (Names{"planned", "done"}));
  EXPECT_EQ(backend_.seen.pictures, 0);
}

TEST_F(WorkerJob, VerifiesEveryPixelOfThePictureAsItIsInTheMemory) {
  job_.compile(compile_message(ball_scene(std::string(settings) + " verify: true")));
  v1::RenderTiles message = both_tiles();
  job_.render(message);  // more tiles are to come
  message.set_last(true);
  job_.render(message);
  const auto all = sent();
  ASSERT_GT(all.size(), 4u);
  EXPECT_GT(all[0].planned().plan().verify_cost(), 0);
  EXPECT_FALSE(all[3].done().has_accuracy());
  const v1::Accuracy same = all.back().done().accuracy();
  EXPECT_EQ(same.error().pixels(), 32u * 16);
  EXPECT_EQ(same.error().share(), 1);
  EXPECT_EQ(same.error().maximum(), 0) << "the fake draws the same by every method";
  EXPECT_TRUE(same.kept());
  EXPECT_GT(all.back().done().timing().verify(), 0);
  EXPECT_EQ(all[all.size() - 2].tiles_verified().tiles(), 2u);

  // One pixel is another one, and no tile is drawn again.
  void* memory =
      mmap(nullptr, 64 * 64 * 12, PROT_READ | PROT_WRITE, MAP_SHARED, options_.film_descriptor, 0);
  static_cast<float*>(memory)[(3 * 32 + 20) * 3 + 1] *= 2;
  v1::RenderTiles none;
  none.set_last(true);
  job_.render(none);
  const v1::ColorError other = sent().back().done().accuracy().error();
  EXPECT_GT(other.maximum(), 1);
  EXPECT_NEAR(other.mean() * 32 * 16, other.maximum(), 1e-9);
  EXPECT_EQ(other.percentile_95(), 0);
}

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

TEST_F(WorkerJob, APromiseThatOnePixelBreaksIsBroken) {
  job_.compile(
      compile_message(ball_scene(std::string(settings) + " verify: true goal { tolerance: 0.5 }")));
  v1::RenderTiles message = both_tiles();
  message.set_last(true);
  job_.render(message);
  EXPECT_TRUE(sent().back().done().accuracy().kept());
  void* memory =
      mmap(nullptr, 64 * 64 * 12, PROT_READ | PROT_WRITE, MAP_SHARED, options_.film_descriptor, 0);
  static_cast<float*>(memory)[(3 * 32 + 20) * 3] *= 2;
  message.clear_tile();
  job_.render(message);
  v1::JobDone done = sent().back().done();
  EXPECT_FALSE(done.accuracy().kept());
  EXPECT_FALSE(done.has_better()) << "none is better than exact";

  Job naive(6, options_, link_, work_, turns_);
  v1::CompileJob compile =
      compile_message(ball_scene(std::string(settings) + " verify: true goal { tolerance: 0.5 }"));
  compile.mutable_chosen()->mutable_rgb();
  naive.compile(compile);
  naive.render(message);  // the memory as it is, with its pixel
  done = sent().back().done();
  EXPECT_FALSE(done.accuracy().kept());
  EXPECT_TRUE(done.better().has_exact());
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

TEST_F(WorkerJob, GivesViewsTheirTurnsOnceATurnHasPassed) {
  job_.compile(compile_message(ball_scene(settings)));
  job_.render(both_tiles());
  EXPECT_EQ(turns_.served_, 0);
  EXPECT_EQ(backend_.seen.draws, 1);

  turns_.waiting_ = true;
  backend_.before_tile = [] { std::this_thread::sleep_for(turn_time * 1.5); };
  job_.render(both_tiles());
  EXPECT_EQ(turns_.served_, 1);  // between its two tiles
  EXPECT_EQ(backend_.seen.draws, 3);
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

/// A pixel that is seen over so many surfaces, at places between the nodes of their tables: twice
/// as many products for each.
Gather over_surfaces(int count) {
  Gather gather(1);
  std::uint32_t chain = 0;
  for (int i = 0; i < count; ++i)
    chain = gather.chain(chain, {FactorKind::transmit, 0, 0.5f + 0.0123f * static_cast<float>(i)});
  gather.add(chain, 0, FactorNode{FactorKind::white, 0, 0}, 1);
  return gather;
}

TEST_F(WorkerJob, SaysBeforehandThatAPictureHasTooManyFactors) {
  constexpr const char* glass =
      "material { name: 'glass' fresnel { dielectric { medium: 'water' } } transmission {} } "
      "object "
      "{ name: 'drop' material: 'glass' sphere { center { x: 3 } radius: 0.1 } }";
  const struct {
    int surfaces;
    std::uint32_t tile;
    std::string field;
  } cases[] = {{2, 16, ""}, {10, 8, "settings.tile_size"}, {13, 16, "settings.depth"}};
  for (const auto& one : cases) {
    SCOPED_TRACE(one.surfaces);
    backend_.traced_ = {over_surfaces(one.surfaces)};
    v1::CompileJob message = compile_message(ball_scene(settings, glass));
    message.set_keep_factors(true);
    Job job(5, options_, link_, work_, turns_);
    job.compile(message);
    std::string field;
    for (const v1::WorkerEnvelope& planned : sent()) {
      if (!planned.has_planned()) continue;
      EXPECT_EQ(planned.planned().plan().tile_size(), one.tile);
      for (const v1::Notice& notice : planned.planned().plan().notice())
        if (notice.message().find("factors") != std::string::npos) field += notice.field();
    }
    EXPECT_EQ(field, one.field);
    job.render(both_tiles());
    const bool kept = one.field != "settings.depth";
    EXPECT_EQ(sent_names(),
              kept ? Names({"factors_piece", "tile_done", "factors_piece", "tile_done", "done"})
                   : Names({"tile_done", "tile_done", "done"}));
  }
}

TEST_F(WorkerJob, SendsATilesFactorsBeforeTheTile) {
  v1::CompileJob message = compile_message(ball_scene(settings));
  message.set_keep_factors(true);
  job_.compile(message);
  job_.render(both_tiles());
  EXPECT_EQ(sent_names(), (Names{"factors_piece", "planned", "factors_piece", "tile_done",
                                 "factors_piece", "tile_done", "done"}));
}

}  // namespace
}  // namespace metamer::worker
