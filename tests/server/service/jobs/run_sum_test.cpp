// What several attempts of a job came to is one record.
#include "server/service/jobs/run_sum.h"

#include <gtest/gtest.h>

#include <string>

#include "common/wire/frame.h"

namespace metamer::service {
namespace {

v1::RunRecord part_of(const std::string& machine, double render, std::uint64_t rays) {
  v1::RunRecord part;
  part.set_build("abc");
  part.add_machine()->set_name(machine);
  part.mutable_machine(0)->set_threads(2);
  v1::PhaseTime& phase = *part.add_phase();
  phase.set_name("render");
  phase.set_seconds(render);
  phase.set_cpu_seconds(2 * render);
  v1::RayCount& count = *part.add_rays();
  count.set_kind("camera");
  count.set_rays(rays);
  count.set_packets(rays / 8);
  return part;
}

std::uint64_t tiles_of(const v1::RunRecord& record) {
  std::uint64_t sum = 0;
  for (const v1::MachineRecord& machine : record.machine()) sum += machine.tiles();
  return sum;
}

TEST(RunSum, AddsPhasesAndRaysAndKeepsMachinesApart) {
  v1::RunRecord sum;
  add_run(part_of("n1", 1, 80), 5, sum);
  add_run(part_of("n2", 2, 160), 7, sum);
  add_run(part_of("n1", 0.5, 8), 1, sum);
  ASSERT_EQ(sum.machine_size(), 2);
  EXPECT_EQ(sum.machine(0).tiles(), 6u);
  EXPECT_EQ(sum.machine(1).tiles(), 7u);
  ASSERT_EQ(sum.phase_size(), 1);
  EXPECT_EQ(sum.phase(0).seconds(), 3.5);
  EXPECT_EQ(sum.phase(0).cpu_seconds(), 7);
  EXPECT_EQ(sum.rays(0).rays(), 248u);
  EXPECT_EQ(sum.rays(0).packets(), 31u);
  EXPECT_EQ(sum.build(), "abc");
}

TEST(RunSum, OfTilesThatAreVoidTheTimeStays) {
  v1::RunRecord sum;
  add_run(part_of("n1", 1, 80), 5, sum);
  forget_tiles(sum);
  EXPECT_EQ(tiles_of(sum), 0u);
  EXPECT_EQ(sum.rays_size(), 0);
  EXPECT_EQ(sum.phase(0).seconds(), 1);
}

TEST(RunSum, CountsAsManyTilesAsThePictureHas) {
  v1::RunRecord sum;
  add_run(part_of("n1", 1, 80), 5, sum);
  balance_tiles(9, sum);
  ASSERT_EQ(sum.machine_size(), 2);
  EXPECT_EQ(sum.machine(1).name(), "") << "nobody knows whose those of a killed daemon are";
  EXPECT_EQ(tiles_of(sum), 9u);
  balance_tiles(9, sum);
  EXPECT_EQ(sum.machine_size(), 2);
  balance_tiles(2, sum);
  EXPECT_EQ(tiles_of(sum), 2u);
}

TEST(RunSum, OfAWorkerThatLiesIsAControlMessageStill) {
  v1::RunRecord lie;
  lie.set_build(std::string(100'000, 'b'));
  for (int i = 0; i < 1000; ++i) {
    lie.add_machine()->set_name("m");
    lie.add_phase()->set_name(std::to_string(i) + std::string(10'000, 'p'));
    lie.add_rays()->set_kind(std::to_string(i));
    lie.add_warm(std::to_string(i));
  }
  v1::RunRecord sum;
  for (int i = 0; i < 1000; ++i) {
    lie.mutable_machine(0)->set_name(std::to_string(i) + std::string(10'000, 'n'));
    lie.mutable_machine(0)->set_cpu(std::string(10'000, 'c'));
    lie.mutable_machine(0)->set_gpu(std::string(10'000, 'g'));
    lie.mutable_machine(0)->set_isa(std::string(10'000, 'i'));
    add_run(lie, 1, sum);
  }
  EXPECT_EQ(tiles_of(sum), 1000u);
  EXPECT_LT(sum.ByteSizeLong(), wire::max_control_frame - 65'536);
}

}  // namespace
}  // namespace metamer::service
