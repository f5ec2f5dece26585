#pragma once

#include <cstdint>
#include <map>

#include "metamer/v1/session.pb.h"

namespace metamer::service {

/// What has passed between the daemon and all clients since its start.
struct Traffic {
  std::uint64_t greeted = 0;   ///< Sessions that said Hello and were let in.
  std::uint64_t received = 0;  ///< Bytes of messages.
  std::uint64_t sent = 0;      ///< Bytes of frames.
  std::map<v1::Error::Code, std::uint64_t> refusals;
};

}  // namespace metamer::service
