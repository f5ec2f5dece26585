#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace metamer::service {

/// One user, and what it has of what all share.
struct Account {
  std::string name;               ///< As Identity::user.
  std::uint64_t asset_bytes = 0;  ///< Held or on their way; kept by AssetStore.
  double share = 1;               ///< Its weight where several wait.
  /// What it may have; unset: what the server gives anybody.
  std::optional<std::int64_t> max_jobs = {}, max_bytes = {}, max_sessions = {};
  /// The same: seconds of workers within a day; 0: as many as it wants.
  std::optional<double> max_work = {};
  bool admin = false;  ///< Then there is no limit of its work.
};
using AccountPtr = std::shared_ptr<Account>;

class Users;

/// The accounts of all users that are connected or have a job.
class Accounts {
 public:
  /// Of `users`, or of whoever comes where the daemon keeps none.
  explicit Accounts(Users* users = nullptr) : users_(users) {}
  /// Its limits are what the table of users says now. Throws DatabaseError.
  AccountPtr named(const std::string& name);

 private:
  Users* users_;
  std::map<std::string, std::weak_ptr<Account>> accounts_;
};

/// Whether a peer that has `used` may take `more` of something of which `free` are left: it may
/// have at most `peer_share` times what it then leaves. So one peer gets 7/8 of all, a second one
/// 7/8 of the rest, and so on: none takes the last from those who come later (Choudhury and Hahne
/// 1998).
inline constexpr std::uint64_t peer_share = 7;
constexpr bool may_take(std::uint64_t used, std::uint64_t more, std::uint64_t free) {
  return more <= free && used + more <= peer_share * (free - more);
}

/// Who wants a place among the sessions, and what is there.
struct PlaceWanted {
  std::size_t open = 0;  ///< Sessions of all.
  std::size_t own = 0;   ///< Of them, the user's.
  bool listed = false;   ///< The user is in the table.
  bool admin = false;
  std::optional<std::int64_t> max_own = {};  ///< What the table says of it.
};
/// A user's share of `most`; beyond these there are `reserved` for the first session of each user
/// who is known and the first four of admins, who have to get in when others have filled it.
bool may_enter(const PlaceWanted& wanted, std::size_t most, std::size_t reserved);

}  // namespace metamer::service
