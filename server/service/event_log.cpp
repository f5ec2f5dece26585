#include "server/service/event_log.h"

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
  entries_.push_back({++last_sequence_, time, tile});
}

void EventLog::replace_progress(v1::JobEvent event, double time) {
  progress_ = entry(std::move(event), time);
}

void EventLog::replace_preview(v1::JobEvent event, double time) {
  preview_ = entry(std::move(event), time);
}

void EventLog::drop_pictures() {
  std::erase_if(entries_, [](const Entry& entry) { return !entry.event; });
  progress_.reset();
  preview_.reset();
}

std::optional<EventLog::Entry> EventLog::next(std::uint64_t from, Filter filter) const {
  // Find the first logged entry that passes.
  auto found = std::lower_bound(
      entries_.begin(), entries_.end(), from,
      [](const Entry& entry, std::uint64_t sequence) { return entry.sequence < sequence; });
  while (found != entries_.end() && !found->event && !filter.tiles) ++found;
  const Entry* first = found != entries_.end() ? &*found : nullptr;

  // Put the newest progress and preview into their places between the others.
  const auto consider = [&](const std::optional<Entry>& newest) {
    if (!newest || newest->sequence < from) return;
    if (!first || newest->sequence < first->sequence) first = &*newest;
  };
  consider(progress_);
  if (filter.previews) consider(preview_);

  if (!first && ended_) first = &entries_.back();
  if (!first) return std::nullopt;
  return *first;
}

}  // namespace metamer::service
