// What a job does and says of it.
#include "server/worker/job.h"

#include <sys/mman.h>

#include <algorithm>
#include <thread>

#include "tests/server/worker/job_fixture.h"

namespace metamer::worker {
namespace {

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

TEST_F(WorkerJob, RecordsWhatItDidAndWhere) {
  options_.machine.set_name("here");
  options_.machine.set_cpu("a processor");
  job_.compile(compile_message(ball_scene(settings)));
  job_.render(both_tiles());
  const v1::RunRecord record = sent().back().done().record();
  EXPECT_FALSE(record.build().empty());
  ASSERT_EQ(record.machine_size(), 1);
  EXPECT_EQ(record.machine(0).name(), "here");
  EXPECT_EQ(record.machine(0).cpu(), "a processor");
  EXPECT_EQ(record.machine(0).tiles(), 2u);
  Names phases;
  for (const v1::PhaseTime& phase : record.phase()) {
    phases.push_back(phase.name());
    EXPECT_GT(phase.seconds(), 0) << phase.name();
    EXPECT_GT(phase.cpu_seconds(), 0) << phase.name();
  }
  EXPECT_EQ(phases, (Names{"compile", "acceleration", "prepare", "render"}));
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
