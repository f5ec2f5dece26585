#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <set>
#include <string>

#include "common/digest.h"

namespace metamer::service {

/// Which users may hear that the store has an asset: those who have sent it, or have a job that
/// names it. To any other it is missing, so that nobody learns what others have.
class KnownAssets {
 public:
  /// Digests of all users together, some 10 MiB; beyond these the user that has most loses its
  /// oldest, and has to send it again.
  static constexpr std::size_t most = 65536;

  explicit KnownAssets(std::size_t limit = most) : limit_(limit) {}

  void add(const std::string& user, const Digest& digest);
  bool knows(const std::string& user, const Digest& digest) const;
  /// The store has it no more: who sends it next has it for itself.
  void forget(const std::string& user, const Digest& digest);

 private:
  struct User {
    std::set<Digest> digests;
    std::deque<Digest> order;  // as they came
  };
  void drop_oldest();

  std::size_t limit_;
  std::size_t size_ = 0;
  std::map<std::string, User> users_;
};

}  // namespace metamer::service
