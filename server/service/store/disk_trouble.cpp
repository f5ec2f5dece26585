#include "server/service/store/disk_trouble.h"

#include <spdlog/spdlog.h>

#include <cerrno>

namespace metamer::service {

void DiskTrouble::refused(const std::string& reason) {
  if (!text_) spdlog::error("{} can't be written: {}", what_, reason);
  text_ = what_ + " can't be written: " + reason;
}

void DiskTrouble::taken() {
  if (text_) spdlog::info("{} can be written again", what_);
  text_.reset();
}

bool is_want_of_room(int error) { return error == ENOSPC || error == EDQUOT; }

}  // namespace metamer::service
