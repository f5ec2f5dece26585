#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace metamer::service {

/// Bounds of a user's share, its weight beside others.
inline constexpr double min_share = 1e-3;
inline constexpr double max_share = 1e3;
/// Seconds that a turn costs at least: jobs that take no time at all are not free.
inline constexpr double least_turn = 1e-3;

/// How long a turn lasts, in seconds, while others wait: `quantum`; where it took `beginning` to
/// come to its first tile 20 times that, so that at most a twentieth is lost by beginning anew; but
/// no longer than 30 s, or `quantum` where that is more, since others wait for it. What beginnings
/// take is charged to whose they are.
double turn_seconds(double quantum, double beginning);

/// A job that waits.
struct Claim {
  std::string_view user;
  std::int32_t priority = 0;  ///< Among the same user's: higher first,
  std::uint64_t order = 0;    ///< then the lower one.
};

/// Shares one worker among users, by the seconds that it spends on each: start-time fair queueing
/// (Goyal, Guo and Vin 1996). A user's tag rises by seconds / share; who wants a turn and has the
/// lowest tag gets it; who comes back begins at the tag of the turn under way, without credit for
/// the time that he wanted nothing. So among users who want turns all the time, seconds / share
/// differ by one turn of each at most, and whoever comes waits for one turn of each other at most.
class FairShare {
 public:
  /// Says whether a user has any job that waits or has its turn.
  void set_present(std::string_view user, bool present);
  /// Which of these, whose users are present, is next; nothing where there is none. The same for
  /// the same history, in whatever order they stand.
  std::optional<std::size_t> choose(std::span<const Claim> waiting) const;
  /// The user's turn begins, or the next one of the same job.
  void begin(std::string_view user, double share);
  /// The worker has spent so many seconds on the user's job; share in min_share..max_share.
  void charge(std::string_view user, double share, double seconds);

  /// How far a user is ahead of the turn under way, in seconds of a user of share 1; below 0:
  /// behind, since what it wants could not be begun.
  struct Lead {
    std::string user;
    double seconds = 0;
  };
  /// What has to outlive the program, lest who has had more than others should begin with them.
  std::vector<Lead> leads() const;
  /// Goes on with what was kept; who is present already and has none begins at the turn under way.
  void restore(const std::vector<Lead>& kept);

  /// Of how many users anything is known: those present, and who have had more than others so far.
  std::size_t size() const { return users_.size(); }

 private:
  struct User {
    double tag = 0;  ///< In seconds of a user of share 1: when his next turn would begin.
    std::uint64_t turn =
        0;  ///< His last one's number, or of his coming; of equal tags the oldest is first.
    bool present = false;
  };
  void forget_settled();

  std::map<std::string, User, std::less<>> users_;
  double now_ = 0;  ///< The tag with which the turn under way began.
  std::uint64_t turns_ = 0;
};

}  // namespace metamer::service
