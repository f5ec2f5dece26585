#pragma once

#include <cstdint>
#include <string>

#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::client {

/// "640x480, 16 samples per pixel, point at 61 wavelengths from 400 to 700 nm, …"
std::string describe(const v1::Plan& plan);
/// "1.24 s rendering (45.1 Mrays/s), 1.50 s in all"
std::string describe(const v1::Timing& timing);
/// "0.120 s reading, 0.031 s hierarchy, 0.000 s choosing, 0.004 s tables": before the first tile.
std::string prepared_text(const v1::Timing& timing);
/// "7@3f9c2a1b  running   120/300  0:42  cpu  alice  booth.txtpb": handle, state, tiles, age,
/// backend, whose, name, and why it failed. `server`: as JobHandle::server.
std::string describe(const v1::JobSummary& job, const std::string& server);
/// "waits: 2 of the same user's are ahead"; empty where it waits for nothing.
std::string waiting_text(const v1::JobSummary& job);
/// "12  3.204 s  progress 120/300 tiles, 1200000 rays": one line, no pixels.
std::string describe(const v1::JobEvent& event);

const char* word(v1::JobState state);
const char* word(v1::Preparing::Stage stage);

/// "0:07", "1:02:03"; "-:--" for what is no sensible time.
std::string clock(double seconds);
/// "1 light", "2 lights"
std::string counted(std::uint64_t count, const char* one, const char* many);
/// "12.3 Mrays/s"; "- Mrays/s" before any time has passed.
std::string rate(std::uint64_t rays, double seconds);

}  // namespace metamer::client
