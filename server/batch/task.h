#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/wire/tiles.h"
#include "metamer/v1/batch.pb.h"
#include "server/batch/own_worker.h"

namespace metamer::batch {

/// Whether two plans make the same picture, bit for bit: all that they say but how many threads
/// draw it, what was measured on the way, and what is said to people.
bool same_picture(const v1::Plan& a, const v1::Plan& b);

/// One order, carried out by a worker that has been started for it.
class Task {
 public:
  /// Both outlive it.
  Task(const v1::BatchOrder& order, OwnWorker& worker) : order_(order), worker_(worker) {}

  /// To be called once. What goes wrong is in the result: `failed`, or `lost`.
  v1::BatchResult run(unsigned threads);

 private:
  using Clock = std::chrono::steady_clock;
  /// What ends a step; an error is a worker that is lost, and a Failed is in the result.
  Result<void> carry_out(unsigned threads);
  Result<void> hear_until(v1::WorkerEnvelope::BodyCase wanted);
  Result<void> take(v1::WorkerEnvelope message);
  Result<void> take_plan(const v1::Plan& plan);
  Result<void> take_tile(const v1::TileDone& done);
  Result<void> take_factors(const v1::FactorsPiece& piece);
  Result<void> render(std::uint32_t first, std::uint32_t count, bool last);
  Result<void> render_for_a_while(unsigned threads);
  std::uint32_t most_in_a_result() const;
  std::optional<std::uint32_t> place_of(const v1::TileRect& tile) const;
  bool failed() const { return result_.has_failed(); }

  const v1::BatchOrder& order_;
  OwnWorker& worker_;
  v1::BatchResult result_;
  std::optional<v1::Plan> plan_;
  wire::TileGrid grid_;
  std::uint32_t asked_ = 0;  // tiles from order_.first on that the worker has been asked for
  std::vector<bool> done_;   // of them
  std::size_t bytes_ = 0;
  std::uint64_t work_ = 0;  // of the last heartbeat, and when it changed
  Clock::time_point progress_ = Clock::now();
};

}  // namespace metamer::batch
