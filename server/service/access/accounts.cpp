#include "server/service/access/accounts.h"

#include "server/service/access/logins.h"
#include "server/service/access/users.h"

namespace metamer::service {

AccountPtr Accounts::named(const std::string& name) {
  std::erase_if(accounts_, [](const auto& known) { return known.second.expired(); });
  AccountPtr account = accounts_[name].lock();
  if (!account) account = std::make_shared<Account>();
  account->name = name;
  accounts_[name] = account;
  account->admin = is_server_owner(name);
  if (const auto user = users_ ? users_->find(name) : std::nullopt) {
    account->admin = user->role == v1::ADMIN || (user->uid && owns_server(*user->uid));
    account->share = user->share;
    account->max_jobs = user->max_jobs;
    account->max_bytes = user->max_bytes;
    account->max_sessions = user->max_sessions;
    account->max_work = user->max_work;
  }
  return account;
}

bool may_enter(const PlaceWanted& wanted, std::size_t most, std::size_t reserved) {
  constexpr std::size_t admins_first = 4;
  if (wanted.max_own && static_cast<std::int64_t>(wanted.own) >= *wanted.max_own) return false;
  const std::size_t first = wanted.admin ? admins_first : wanted.listed ? 1 : 0;
  if (wanted.own < first) return wanted.open < most + reserved;
  return wanted.open < most && may_take(wanted.own, 1, most - wanted.open);
}

}  // namespace metamer::service
