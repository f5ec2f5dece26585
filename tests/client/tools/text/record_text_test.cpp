// What a job's record reads like, and that a server commands no terminal by it.
#include "client/tools/text/record_text.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

v1::RunRecord record() {
  v1::RunRecord record;
  record.set_build("v1-3-gabc");
  record.set_server_build("v1");
  v1::MachineRecord& machine = *record.add_machine();
  machine.set_name("n1");
  machine.set_cpu("A Processor");
  machine.set_isa("avx512");
  machine.set_lanes(16);
  machine.set_threads(2);
  machine.set_tiles(300);
  v1::PhaseTime& phase = *record.add_phase();
  phase.set_name("render");
  phase.set_seconds(1.5);
  phase.set_cpu_seconds(2.875);
  v1::RayCount& rays = *record.add_rays();
  rays.set_kind("camera");
  rays.set_rays(1200);
  rays.set_packets(100);
  return record;
}

TEST(RecordText, SaysAFactALine) {
  EXPECT_EQ(record_lines(record()),
            (std::vector<std::string>{
                "build    v1-3-gabc, server v1",
                "machine  n1, A Processor, avx512, packets of 16, 2 threads, 300 tiles",
                "phase    render           1.5000 s     2.8750 CPU s", "warm     nothing",
                "rays     camera                  1200 in 100 packets, 75 % of their lanes"}));
}

TEST(RecordText, OfMachinesOfSeveralLaneCountsTellsNoShare) {
  v1::RunRecord mixed = record();
  v1::MachineRecord& other = *mixed.add_machine();
  other.set_lanes(8);
  other.set_tiles(1);
  mixed.add_warm("programs");
  const auto lines = record_lines(mixed);
  EXPECT_EQ(lines[2], "machine  unknown, packets of 8, 1 tile");
  EXPECT_EQ(lines[4], "warm     programs");
  EXPECT_EQ(lines[5], "rays     camera                  1200 in 100 packets");
}

TEST(RecordText, CommandsNoTerminal) {
  v1::RunRecord hostile = record();
  for (std::string* text :
       {hostile.mutable_build(), hostile.mutable_server_build(),
        hostile.mutable_machine(0)->mutable_name(), hostile.mutable_machine(0)->mutable_isa(),
        hostile.mutable_phase(0)->mutable_name(), hostile.mutable_rays(0)->mutable_kind(),
        hostile.add_warm()})
    *text = "a\x1b[2J\nb";
  for (const std::string& line : record_lines(hostile))
    EXPECT_EQ(line.find_first_of("\x1b\n"), std::string::npos) << line;
}

}  // namespace
}  // namespace metamer::client
