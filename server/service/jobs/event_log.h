#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "metamer/v1/jobs.pb.h"

namespace metamer::service {

/// What happened to a job, numbered from 1. A tile is logged as its index alone: its pixels are in
/// the film. Of stages, progress and previews only the newest is kept, under its own number, so a
/// log grows by one small entry a tile and nothing else, however slowly it is read.
class EventLog {
 public:
  struct Entry {
    std::uint64_t sequence = 0;
    double time = 0;                              ///< Seconds since the job was submitted.
    std::uint32_t tile = 0;                       ///< The tile's index, where `event` is null.
    std::shared_ptr<const v1::JobEvent> event{};  ///< Sequence and time are not filled in.
  };
  /// What a reader wants to see.
  struct Filter {
    bool tiles = false;
    bool previews = false;
  };

  void append(v1::JobEvent event, double time);
  /// The same for the last event: nothing may follow it.
  void append_last(v1::JobEvent event, double time);
  void append_tile(std::uint32_t tile, double time);
  void replace_preparing(v1::JobEvent event, double time);
  void replace_progress(v1::JobEvent event, double time);
  void replace_preview(v1::JobEvent event, double time);
  /// Forgets a tile, which comes again.
  void drop_tile(std::uint32_t tile);
  /// Forgets tiles, progress and preview; numbers stay as they are.
  void drop_pictures();

  /// Takes over what was kept of a log: its events and tiles, and the number of the next one.
  void restore(std::vector<Entry> events, std::uint64_t next_sequence, bool ended);
  /// Tiles of before, by their numbers, which are below those of all that are there.
  void restore_tiles(const std::vector<Entry>& tiles);
  /// Readers are given nothing from this number on: it is not on the disk yet.
  void hide_from(std::uint64_t sequence) { hidden_from_ = sequence; }
  /// All that is kept, in order: neither tiles nor what a newer one replaces.
  const std::vector<Entry>& events() const { return entries_; }

  std::uint64_t last_sequence() const { return last_sequence_; }
  bool ended() const { return ended_; }
  /// The first entry numbered `from` or above that passes the filter. Once the log has ended, the
  /// last event is given to whoever asks for more than there is.
  std::optional<Entry> next(std::uint64_t from, Filter filter) const;

 private:
  Entry entry(v1::JobEvent event, double time);

  std::uint64_t last_sequence_ = 0;
  std::uint64_t hidden_from_ = std::numeric_limits<std::uint64_t>::max();
  bool ended_ = false;
  struct TileEntry {
    std::uint64_t sequence;
    double time;
    std::uint32_t tile;
  };
  // Each with rising sequence numbers. Apart, since a reader without tiles is to find the next
  // event among millions of them; in pieces, since millions are not to be moved when they become
  // more.
  std::vector<Entry> entries_;
  std::deque<TileEntry> tiles_;
  std::optional<Entry> preparing_;
  std::optional<Entry> progress_;
  std::optional<Entry> preview_;
};

}  // namespace metamer::service
