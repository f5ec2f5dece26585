#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "metamer/v1/worker.pb.h"
#include "server/service/executors/worker_process.h"

namespace metamer::fuzz {

/// What the scene asset says.
struct Script {
  std::uint32_t width = 64, height = 48, tile = 16;
  std::map<std::string, std::uint32_t> at;  // a word, and its number
  bool has(const std::string& word) const { return at.contains(word); }
};

/// What one worker is at.
struct Worker {
  service::WorkerCommand command;
  service::WorkerProcess::Handlers handlers;
  std::string killed_for;  // or empty
  bool ready = false;
  bool dies = false;
  std::deque<v1::WorkerEnvelope> orders;
  std::uint64_t job = 0;
  Script script;
  bool first_attempt = true;
  v1::CompileJob compile;
  std::deque<v1::TileRect> tiles;  // asked for
  bool rendering = false, last_batch = false;
  std::uint32_t done = 0;
  std::uint64_t work = 0;
  std::map<std::uint64_t, Script> views;
  std::deque<v1::WorkerEnvelope> says;
};

/// Does one thing. What there is to say goes first, then orders, and tiles when there is nothing
/// else. `may_be_ready`: it says so where it has not.
void work(Worker& worker, bool may_be_ready);
/// Which jobs were attempted.
void forget_attempts();

}  // namespace metamer::fuzz
