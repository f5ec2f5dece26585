#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/problem.h"
#include "metamer/v1/worker.pb.h"

/// Frames over a connected socket with plain blocking calls, for a process that has nothing else
/// to wait for. Any thread; one reader and one writer at a time.
namespace metamer::wire {

/// The next frame's payload; nothing when the peer closed between two frames. Takes no byte of the
/// frame after it. Errors: closed in mid-frame, a length of 0 or above max_frame, a system error.
Result<std::optional<std::string>> read_frame(int fd);

/// Sends `payload` (at most max_frame bytes) as one frame. Errors: the system's, with its text;
/// a peer that is gone is an error, never a signal.
Result<void> write_frame(int fd, std::string_view payload);
/// The same for frames that encode_frame has made, one behind the other.
Result<void> write_frames(int fd, std::string_view frames);

/// The same for the messages between metamerd and a worker. Another error: not a WorkerEnvelope.
Result<std::optional<v1::WorkerEnvelope>> read_envelope(int fd);
Result<void> write_envelope(int fd, const v1::WorkerEnvelope& envelope);

}  // namespace metamer::wire
