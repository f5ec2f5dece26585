#pragma once

#include <string>
#include <vector>

#include "metamer/v1/worker.pb.h"

/// Workers without processes: scripted_worker.cpp stands in the place of worker_process.cpp. A
/// worker does what the scene asset says, a script of words as that of metamer-fake-worker:
///   picture W H T   its size and its tiles' (default 64 48 16)
///   fail            Failed in place of a plan
///   crash N         gone after N tiles;  once: in the first attempt only
///   stuck N         after N tiles nothing more, but beats
///   deaf            no answer to StopJob
///   stages          says what is being prepared, and when it is there
///   factors N       N bytes of factors for the scene and for each tile
///   broken          the promise is broken, until `exact` is asked for
///   verify          plans a check of the picture
///   refuse          a view's updates are refused;  shut: it is closed
namespace metamer::fuzz {

/// How the next workers' starts fail.
enum class Start { works, lacks_memory, fails, never_ready };
void set_start(Start start);

/// Lets each worker do so many things: say that it is ready, carry an order out, render a tile.
void let_workers_work(unsigned things);
/// A sign of life of each.
void let_workers_beat();
/// Each says this, whether it is true or not; a job_id of 0 becomes that of its job.
void let_workers_say(const v1::WorkerEnvelope& message);
/// Each ends by itself.
void end_workers();
/// Forgets which jobs were attempted, and how starts fail.
void forget_scripts();
/// How many run.
std::size_t count_workers();

}  // namespace metamer::fuzz
