#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace metamer::service {

/// The ended jobs that are still known, and which of them goes first where these are too many.
/// A user whose jobs take no more than its share of what all may take loses none to others (max-min
/// fairness by weights, Demers, Keshav and Shenker 1989): the share is its weight beside those of
/// all who have any. Of those over theirs, who has most for its weight loses its oldest.
class Retention {
 public:
  struct Entry {
    std::uint64_t job = 0;
    std::uint64_t bytes = 0;
    double ended_at = 0;  ///< Seconds since 1970.
  };
  enum class Measure { jobs, bytes };

  /// A job of the user's has ended. `share`: the user's weight, above 0, from now on.
  void add(std::string_view user, double share, const Entry& entry);
  std::uint64_t total(Measure measure) const;
  /// Takes out the job that goes first where all may take `most`, but never `newest`. Nothing: all
  /// is within that, or would be but for that one.
  std::optional<std::uint64_t> take_beyond(Measure measure, std::uint64_t most,
                                           std::uint64_t newest);
  /// Takes out a job that ended before `time`, or after one that goes for that reason.
  std::optional<std::uint64_t> take_before(double time);

 private:
  struct User {
    double share = 1;
    std::deque<Entry> entries;  // oldest first
    std::uint64_t bytes = 0;
  };
  using Users = std::map<std::string, User, std::less<>>;
  static std::uint64_t amount(const User& user, Measure measure);
  std::uint64_t take_oldest(Users::iterator user);

  Users users_;
  std::uint64_t jobs_ = 0, bytes_ = 0;
};

}  // namespace metamer::service
