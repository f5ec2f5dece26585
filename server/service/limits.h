#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "common/scene/limits.h"
#include "common/wire/frame.h"
#include "metamer/v1/session.pb.h"

/// What the service accepts and keeps. Each bound has its reason; those that `Limits` and
/// `Patience` begin with can be set (ops/options.cpp).
namespace metamer::service {

/// Jobs that have not ended, and ended ones that are still known: some kilobytes each.
inline constexpr std::size_t max_live_jobs = 256;
inline constexpr std::size_t max_ended_jobs = 256;
/// A JobList has no further job beyond so many: with one more, and its envelope, it is a control
/// message still.
inline constexpr std::size_t max_list_bytes = wire::max_control_frame - 4096;
/// Among the jobs of one user, either way: finer than people tell apart.
inline constexpr std::int32_t max_priority = 100;
/// Workers that a job may lose before it fails: what happens to it thrice is its own doing.
inline constexpr std::uint32_t max_losses = 3;
/// Numbers of events that are kept as given before they are: one more row for so many.
inline constexpr std::uint64_t sequence_reserve = 4096;
/// Seconds that a worker may have spent on a job, or on a backend's jobs, before the state is told:
/// a crash gives no more than these away.
inline constexpr double most_unkept_seconds = 10;
/// Bytes of Submit.client_key: two digests.
inline constexpr std::size_t max_client_key = 64;
inline constexpr std::size_t max_job_name = 200;  ///< Bytes; it is for people.
/// Bytes of a Series' id, exactly, of its name and of a label; and how many jobs it may have.
inline constexpr std::size_t series_id_bytes = 16;
inline constexpr std::size_t max_series_text = 256;
inline constexpr std::uint32_t max_series_jobs = 100'000;
inline constexpr std::size_t max_reason = 200;  ///< Bytes in a summary; the event has it all.
/// Sessions at a time: each costs a descriptor and some 20 KiB while it is silent.
inline constexpr std::size_t max_sessions = 1000;
/// Beyond these, for the first session of each known user and the first four of admins.
inline constexpr std::size_t reserved_sessions = 64;
/// Connections that are not let in yet, and of one source: a user of this machine, an address.
inline constexpr std::size_t max_newcomers = 512;
inline constexpr std::size_t max_newcomers_of_source = 128;
/// TLS handshakes at a time, and of one source: a signature each, some 60 KiB, before anybody is
/// known.
inline constexpr std::size_t max_handshakes = 64;
inline constexpr std::size_t max_handshakes_of_source = 16;
/// A Hello and its token: what is read of anybody at all.
inline constexpr std::size_t max_frame_before_hello = 4096;
/// Watches of one session: each may keep a dropped job's film alive while it reads.
inline constexpr std::size_t max_watches = 16;
/// Views of one session, and of all: each is a scene in a worker's memory.
inline constexpr std::size_t max_session_views = 4;
inline constexpr std::size_t max_views = 16;
/// Frames that a view may have coming: one on its way while the next is drawn. 24 MiB at most, with
/// X Y Z 120.
inline constexpr unsigned max_frame_credits = 2;
/// Assets that one session keeps from eviction: 64 full jobs, 2 MiB of digests.
inline constexpr std::size_t max_held_assets = 65536;
/// Answers that wait for a slow client, and their bytes; then its requests wait too.
inline constexpr std::size_t max_unsent_answers = 64;
inline constexpr std::size_t max_unsent_bytes = wire::max_control_frame;
/// A connection that says nothing is not kept.
inline constexpr std::chrono::seconds hello_timeout{10};
/// After its last answer a session waits this long for the peer to read it and close.
inline constexpr std::chrono::seconds linger_timeout{2};
/// Four a second: as fast as a person reads.
inline constexpr std::chrono::milliseconds progress_interval{250};
/// The longer side of a preview: 64 Ki pixels take 10 ms to encode.
inline constexpr std::uint32_t preview_side = 256;
/// Tiles in one RenderTiles: 14 bytes each at most, 3.5 MB, which a frame holds. Only pictures near
/// the largest need a second batch.
inline constexpr std::size_t tiles_per_batch = 250'000;

/// How many there may be. SIGHUP changes them; what is there already stays.
struct Limits {
  std::uint64_t sessions = max_sessions;
  std::uint64_t session_watches = max_watches;
  std::uint64_t views = max_views;
  std::uint64_t session_views = max_session_views;
  std::uint64_t held_assets = max_held_assets;  ///< Of a session.
  std::uint64_t live_jobs = max_live_jobs;
  std::uint64_t ended_jobs = max_ended_jobs;
  std::uint64_t handshakes = max_handshakes;
  std::uint64_t source_handshakes = max_handshakes_of_source;
  std::uint64_t keep_days = 0;  ///< That an ended job stays; 0: until its room is wanted.
  /// Seconds that workers may spend on one user's jobs within a day; 0: as many as it wants.
  std::uint64_t user_work = 0;
  /// Bytes that jobs that run may take together, as estimated; 0: as much as they want.
  std::uint64_t memory = 0;
};

inline constexpr Limits default_limits{};

/// How long a client may do nothing with what it keeps from others.
struct Patience {
  std::chrono::milliseconds hello{hello_timeout};
  /// From the first byte of a TLS handshake to its end, where others wait for its place.
  std::chrono::milliseconds handshake{1'000};
  /// A session that says, reads and watches nothing; closed once its place is wanted.
  std::chrono::milliseconds idle_session{60'000};
  /// In which a client takes no byte of what is sent to it.
  std::chrono::milliseconds stall{30'000};
  /// Between two looks whether those who are in were revoked.
  std::chrono::milliseconds recheck{2'000};
  /// Between two chunks of an upload, which may be 4 MiB over a slow line.
  std::chrono::milliseconds upload{120'000};
};

inline v1::Limits limits_message(const Limits& set) {
  v1::Limits message;
  message.set_control_frame(wire::max_control_frame);
  message.set_chunk(wire::max_chunk);
  message.set_asset(limits::max_asset);
  message.set_assets_per_job(limits::max_assets);
  message.set_queued_jobs(set.live_jobs);
  message.set_pixels(limits::max_pixels);
  message.set_view_pixels(limits::max_view_pixels);
  message.set_views(static_cast<std::uint32_t>(set.session_views));
  message.set_watches(static_cast<std::uint32_t>(set.session_watches));
  return message;
}

}  // namespace metamer::service
