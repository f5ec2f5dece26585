#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/digest.h"
#include "server/service/jobs/job.h"

namespace metamer::service {

/// Tiles `first` to `first + count - 1` of a job's plan, in rendering order (TileGrid).
struct TileRange {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  bool operator==(const TileRange&) const = default;
};

/// A range that is to be rendered. `attempt` is said with the result, and never comes twice: not
/// for the same range, nor in a later TileRanges of the job.
struct RangeOrder {
  std::uint64_t job = 0;
  std::uint64_t attempt = 0;
  TileRange range;
};

/// What became of an order: all tiles of its range, in order.
struct RangeResult {
  struct Tile {
    std::uint64_t rays = 0;
    std::string xyz;      ///< f32, little-endian, row by row, of the tile's rectangle.
    std::string factors;  ///< A TileFactors, if the job keeps factors.
  };
  std::uint64_t attempt = 0;
  std::vector<Tile> tiles;
  Digest digest{};  ///< By whoever rendered it: see digest_of().
};

/// SHA-256 of an order and its tiles: numbers as 8 bytes, little-endian; job, attempt, first and
/// count, then of each tile rays, the length of its pixels, these, and likewise its factors.
Digest digest_of(const RangeOrder& order, const std::vector<RangeResult::Tile>& tiles);

/// Whether pixels and factors are as many as a tile of this job's plan may have.
bool fits(const Job& job, std::uint32_t index, const RangeResult::Tile& tile);
/// Makes a tile that fits, and is not done, a running job's.
void put_tile(Job& job, std::uint32_t index, RangeResult::Tile tile);

/// The tiles that a running job lacks, cut into ranges that are rendered wherever, in any order,
/// more than once if need be. Of each range the first whole result counts: its tiles become the
/// job's. A later one is dropped, a damaged one is refused, and whatever is refused or lost is
/// handed out again.
///
/// Attempts are rendered with the job's plan as it stands; one that replaces it (Job::restart)
/// wants new ranges.
class TileRanges {
 public:
  /// Of a job that has its film. `attempts` are numbered from there on; both outlive this.
  TileRanges(Job& job, std::uint64_t& attempts, std::uint32_t most_tiles);

  /// The next range that nobody has; nothing when all are done or out.
  std::optional<RangeOrder> hand_out();
  /// The same range once more, beside an attempt that takes long. Nothing: that one is not out.
  std::optional<RangeOrder> hand_out_again(std::uint64_t attempt);

  enum class Verdict {
    counts,   ///< The first whole result of its range.
    late,     ///< Another was first, or nobody waits for that attempt any more.
    damaged,  ///< Not what was rendered, or not of that range.
  };
  Verdict take(RangeResult result);
  /// Nothing will come of an attempt.
  void lose(std::uint64_t attempt);
  /// The same, and the job had no part in it: that counts for nothing.
  void withdraw(std::uint64_t attempt);

  /// How many nobody has.
  std::size_t waiting() const;
  bool complete() const { return done_ == ranges_.size(); }
  /// A range has been lost or damaged max_losses times: that is the job's doing.
  bool hopeless() const { return hopeless_; }

 private:
  struct Range {
    TileRange tiles;
    std::uint32_t out = 0;       // attempts at it
    std::uint32_t failures = 0;  // lost ones and damaged ones
    bool done = false;
  };
  struct Out {
    RangeOrder order;
    std::size_t range;
  };
  RangeOrder order(std::size_t range);
  std::vector<Out>::iterator find(std::uint64_t attempt);
  void fail(std::vector<Out>::iterator out);
  bool is_whole(const RangeOrder& order, const RangeResult& result) const;

  Job& job_;
  std::uint64_t& attempts_;
  std::vector<Range> ranges_;
  std::vector<Out> out_;
  std::size_t done_ = 0;
  bool hopeless_ = false;
};

}  // namespace metamer::service
