#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "common/scene/limits.h"
#include "common/wire/frame.h"
#include "metamer/v1/session.pb.h"

/// What the service accepts and keeps. Each bound has its reason.
namespace metamer::service {

/// Jobs that have not ended. With as many ended ones, a JobList stays a control message:
/// 512 × (max_job_name + max_reason + 80) bytes = 240 KiB.
inline constexpr std::size_t max_live_jobs = 256;
inline constexpr std::size_t max_ended_jobs = 256;
inline constexpr std::size_t max_job_name = 200;  ///< Bytes; it is for people.
inline constexpr std::size_t max_reason = 200;    ///< Bytes in a summary; the event has it all.
/// Connections at a time: each costs a descriptor and 128 KiB of buffers. More than a team has
/// clients, far fewer than the 1,024 descriptors of a process.
inline constexpr std::size_t max_sessions = 64;
/// Watches of one session: each may keep a dropped job's film alive while it reads.
inline constexpr std::size_t max_watches = 16;
/// Views of one session, and of all: each is a scene in a worker's memory.
inline constexpr std::size_t max_session_views = 4;
inline constexpr std::size_t max_views = 16;
/// Frames that a view may have coming: one on its way while the next is drawn. 24 MiB at most.
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
/// Of one picture's factors: ten times what a 4K picture takes.
inline constexpr std::uint64_t max_job_factors = std::uint64_t{4} << 30;
/// Tiles in one RenderTiles: 14 bytes each at most, 3.5 MB, which a frame holds. Only pictures near
/// the largest need a second batch.
inline constexpr std::size_t tiles_per_batch = 250'000;

/// How long a client may do nothing with what it keeps from others.
struct Patience {
  /// A session that says, reads and watches nothing; closed once its place is wanted.
  std::chrono::milliseconds idle_session{60'000};
  /// Between two chunks of an upload, which may be 4 MiB over a slow line.
  std::chrono::milliseconds upload{120'000};
};

inline v1::Limits limits_message() {
  v1::Limits message;
  message.set_control_frame(wire::max_control_frame);
  message.set_chunk(wire::max_chunk);
  message.set_asset(limits::max_asset);
  message.set_assets_per_job(limits::max_assets);
  message.set_queued_jobs(max_live_jobs);
  message.set_pixels(limits::max_pixels);
  return message;
}

}  // namespace metamer::service
