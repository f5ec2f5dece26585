#include "server/service/store/record_row.h"

#include <cstdint>
#include <cstring>

#include "server/service/store/crc32c.h"

namespace metamer::service {

std::string encode_record(const v1::JobRecord& record) {
  std::string row(sizeof(std::uint32_t), '\0');
  record.AppendToString(&row);
  const std::uint32_t sum = crc32c(std::string_view(row).substr(sizeof sum));
  std::memcpy(row.data(), &sum, sizeof sum);
  return row;
}

std::optional<v1::JobRecord> decode_record(std::string_view row) {
  std::uint32_t sum = 0;
  if (row.size() < sizeof sum) return std::nullopt;
  std::memcpy(&sum, row.data(), sizeof sum);
  const std::string_view message = row.substr(sizeof sum);
  v1::JobRecord record;
  if (crc32c(message) != sum ||
      !record.ParseFromArray(message.data(), static_cast<int>(message.size())))
    return std::nullopt;
  return record;
}

}  // namespace metamer::service
