#include "server/service/jobs/event_log.h"

#include <algorithm>
#include <cassert>

namespace metamer::service {

EventLog::Entry EventLog::entry(v1::JobEvent event, double time) {
  assert(!ended_);
  return {++last_sequence_, time, 0, std::make_shared<const v1::JobEvent>(std::move(event))};
}

void EventLog::append(v1::JobEvent event, double time) {
  entries_.push_back(entry(std::move(event), time));
}

void EventLog::append_last(v1::JobEvent event, double time) {
  append(std::move(event), time);
  ended_ = true;
}

void EventLog::append_tile(std::uint32_t tile, double time) {
  assert(!ended_);
  tiles_.push_back({++last_sequence_, time, tile});
}

void EventLog::replace_preparing(v1::JobEvent event, double time) {
  preparing_ = entry(std::move(event), time);
}

void EventLog::replace_progress(v1::JobEvent event, double time) {
  progress_ = entry(std::move(event), time);
}

void EventLog::replace_preview(v1::JobEvent event, double time) {
  preview_ = entry(std::move(event), time);
}

void EventLog::drop_tile(std::uint32_t tile) {
  std::erase_if(tiles_, [&](const TileEntry& entry) { return entry.tile == tile; });
}

void EventLog::drop_pictures() {
  tiles_.clear();
  progress_.reset();
  preview_.reset();
}

void EventLog::restore(std::vector<Entry> events, std::uint64_t next_sequence, bool ended) {
  assert(!events.empty());
  entries_ = std::move(events);
  last_sequence_ = ended ? entries_.back().sequence : next_sequence - 1;
  ended_ = ended;
}

void EventLog::restore_tiles(const std::vector<Entry>& tiles) {
  tiles_.clear();
  for (const Entry& tile : tiles) tiles_.push_back({tile.sequence, tile.time, tile.tile});
}

std::optional<EventLog::Entry> EventLog::next(std::uint64_t from, Filter filter) const {
  const auto before = [](const auto& entry, std::uint64_t sequence) {
    return entry.sequence < sequence;
  };
  std::optional<Entry> first;
  const auto consider = [&](const Entry& entry) {
    if (entry.sequence >= from && (!first || entry.sequence < first->sequence)) first = entry;
  };
  const auto event = std::lower_bound(entries_.begin(), entries_.end(), from, before);
  if (event != entries_.end()) consider(*event);
  if (filter.tiles) {
    const auto tile = std::lower_bound(tiles_.begin(), tiles_.end(), from, before);
    if (tile != tiles_.end()) consider({tile->sequence, tile->time, tile->tile});
  }
  // The newest stage, progress and preview have their places between the others.
  if (preparing_) consider(*preparing_);
  if (progress_) consider(*progress_);
  if (filter.previews && preview_) consider(*preview_);

  if (!first && ended_) first = entries_.back();
  if (first && first->sequence >= hidden_from_) return std::nullopt;
  return first;
}

}  // namespace metamer::service
