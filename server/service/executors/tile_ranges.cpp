#include "server/service/executors/tile_ranges.h"

#include <algorithm>
#include <utility>

#include "common/wire/frame.h"
#include "server/service/limits.h"

namespace metamer::service {

namespace {

void add_number(DigestStream& sum, std::uint64_t number) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xFF);
  sum.update(bytes);
}

std::size_t bytes_of(const Rect& rect) {
  return std::size_t{rect.width} * rect.height * Film::pixel_bytes;
}

}  // namespace

Digest digest_of(const RangeOrder& order, const std::vector<RangeResult::Tile>& tiles) {
  DigestStream sum;
  for (const std::uint64_t number : {order.job, order.attempt, std::uint64_t{order.range.first},
                                     std::uint64_t{order.range.count}})
    add_number(sum, number);
  for (const RangeResult::Tile& tile : tiles) {
    add_number(sum, tile.rays);
    add_number(sum, tile.xyz.size());
    sum.update(tile.xyz);
    add_number(sum, tile.factors.size());
    sum.update(tile.factors);
  }
  return sum.finish();
}

bool fits(const Job& job, std::uint32_t index, const RangeResult::Tile& tile) {
  const std::size_t most_factors = job.submit().keep_factors() ? wire::max_factors : 0;
  return index < job.tiles().size() && tile.xyz.size() == bytes_of(job.tiles().rect(index)) &&
         tile.factors.size() <= most_factors;
}

void put_tile(Job& job, std::uint32_t index, RangeResult::Tile tile) {
  job.film().paste(job.tiles().rect(index), tile.xyz);
  // A picture outlives its factors: a tile beyond what is kept has none.
  if (!tile.factors.empty()) (void)job.add_factors(index, tile.factors);
  job.add_tile(index, tile.rays);
}

TileRanges::TileRanges(Job& job, std::uint64_t& attempts, std::uint32_t most_tiles)
    : job_(job), attempts_(attempts) {
  for (const std::uint32_t tile : job.missing_tiles(job.tiles().size())) {
    Range* last = ranges_.empty() ? nullptr : &ranges_.back();
    const bool follows = last && tile == last->tiles.first + last->tiles.count;
    if (follows && last->tiles.count < most_tiles)
      ++last->tiles.count;
    else
      ranges_.push_back({.tiles = {tile, 1}});
  }
}

RangeOrder TileRanges::order(std::size_t range) {
  ++ranges_[range].out;
  out_.push_back({{job_.id(), ++attempts_, ranges_[range].tiles}, range});
  return out_.back().order;
}

std::optional<RangeOrder> TileRanges::hand_out() {
  const auto next = std::find_if(ranges_.begin(), ranges_.end(),
                                 [](const Range& one) { return !one.done && one.out == 0; });
  if (next == ranges_.end()) return std::nullopt;
  return order(static_cast<std::size_t>(next - ranges_.begin()));
}

std::optional<RangeOrder> TileRanges::hand_out_again(std::uint64_t attempt) {
  const auto found = find(attempt);
  if (found == out_.end() || ranges_[found->range].done) return std::nullopt;
  return order(found->range);
}

std::vector<TileRanges::Out>::iterator TileRanges::find(std::uint64_t attempt) {
  return std::find_if(out_.begin(), out_.end(),
                      [&](const Out& one) { return one.order.attempt == attempt; });
}

void TileRanges::fail(std::vector<Out>::iterator out) {
  Range& range = ranges_[out->range];
  --range.out;
  if (!range.done && ++range.failures >= max_losses) hopeless_ = true;
  out_.erase(out);
}

void TileRanges::lose(std::uint64_t attempt) {
  if (const auto found = find(attempt); found != out_.end()) fail(found);
}

void TileRanges::withdraw(std::uint64_t attempt) {
  const auto found = find(attempt);
  if (found == out_.end()) return;
  --ranges_[found->range].out;
  out_.erase(found);
}

std::size_t TileRanges::waiting() const {
  return static_cast<std::size_t>(std::count_if(
      ranges_.begin(), ranges_.end(), [](const Range& one) { return !one.done && one.out == 0; }));
}

bool TileRanges::is_whole(const RangeOrder& order, const RangeResult& result) const {
  if (result.tiles.size() != order.range.count) return false;
  for (std::uint32_t i = 0; i < order.range.count; ++i)
    if (!fits(job_, order.range.first + i, result.tiles[i])) return false;
  return digest_of(order, result.tiles) == result.digest;
}

TileRanges::Verdict TileRanges::take(RangeResult result) {
  const auto found = find(result.attempt);
  if (found == out_.end()) return Verdict::late;
  const RangeOrder order = found->order;
  Range& range = ranges_[found->range];
  if (!is_whole(order, result)) {
    fail(found);
    return Verdict::damaged;
  }
  --range.out;
  out_.erase(found);
  if (range.done) return Verdict::late;

  // Only a running job takes tiles: one that was cancelled has no use for them.
  if (job_.state() != v1::RUNNING) return Verdict::late;
  range.done = true;
  ++done_;
  for (std::uint32_t i = 0; i < order.range.count; ++i)
    put_tile(job_, order.range.first + i, std::move(result.tiles[i]));
  return Verdict::counts;
}

}  // namespace metamer::service
