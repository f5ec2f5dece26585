#pragma once

#include <optional>
#include <string>

namespace metamer::service {

/// Whether the disk takes what it is given of one kind; each change is logged, once. For the loop's
/// thread.
class DiskTrouble {
 public:
  /// `what` can be written, or can't: "the asset store".
  explicit DiskTrouble(std::string what) : what_(std::move(what)) {}

  /// It has refused something, with all that could make room gone.
  void refused(const std::string& reason);
  /// It has taken something.
  void taken();
  /// "the asset store can't be written: No space left on device"; nothing while all is well.
  const std::optional<std::string>& text() const { return text_; }

 private:
  std::string what_;
  std::optional<std::string> text_;
};

/// ENOSPC, EDQUOT: with room on the disk it would have been done.
bool is_want_of_room(int error);

}  // namespace metamer::service
