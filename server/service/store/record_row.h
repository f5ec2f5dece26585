#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "metamer/v1/record.pb.h"

namespace metamer::service {

// A job's record as it stands in its row: u32 CRC-32C of the message, little-endian, then the
// message. SQLite holds no sums of its own, and a message with a flipped bit may well be one.

std::string encode_record(const v1::JobRecord& record);
/// Nothing where it is not what was written.
std::optional<v1::JobRecord> decode_record(std::string_view row);

}  // namespace metamer::service
