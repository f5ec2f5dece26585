#include "server/service/ops/usage.h"

#include <map>

namespace metamer::service {

namespace {

double seconds_since(Session::Clock::time_point time) {
  return std::chrono::duration<double>(Session::Clock::now() - time).count();
}

}  // namespace

void add_users(const Listener& listener, const JobQueue& queue, Accounts& accounts,
               const std::string& only, v1::Info& info) {
  std::map<std::string, v1::UserUsage> users;
  const auto usage = [&](const AccountPtr& account) -> v1::UserUsage* {
    if (!account || (!only.empty() && account->name != only)) return nullptr;
    v1::UserUsage& user = users[account->name];
    user.set_asset_bytes(account->asset_bytes);
    user.set_share(account->share);
    user.set_max_day_seconds(queue.most_day_seconds(*account));
    return &user;
  };
  listener.for_each([&](const Session& session) {
    v1::UserUsage* user = usage(session.account());
    if (!user) return;
    user->set_role(session.identity().role);
    user->set_sessions(user->sessions() + 1);
  });
  queue.for_each([&](const Job& job) {
    v1::UserUsage* user = usage(job.owner());
    if (!user) return;
    user->set_jobs_queued(user->jobs_queued() + (job.state() == v1::QUEUED));
    user->set_jobs_running(user->jobs_running() + (job.state() == v1::RUNNING));
    user->set_jobs_ended(user->jobs_ended() + job.ended());
    user->set_picture_bytes(user->picture_bytes() + job.picture_bytes());
    user->set_worker_seconds(user->worker_seconds() + job.worker_seconds());
  });
  for (const auto& [name, seconds] : queue.day_seconds())
    if (v1::UserUsage* user = name.empty() ? nullptr : usage(accounts.named(name)))
      user->set_day_seconds(seconds);
  for (auto& [name, user] : users) {
    user.set_user(name);
    *info.add_user() = std::move(user);
  }
}

void add_sessions(const Listener& listener, v1::Info& info) {
  listener.for_each([&](const Session& session) {
    v1::SessionInfo& one = *info.add_session();
    one.set_user(session.identity().user);
    one.set_peer(session.visitor().source());
    one.set_client(session.client());
    one.set_age(seconds_since(session.begun()));
    one.set_idle(seconds_since(session.last_progress()));
    one.set_watches(static_cast<std::uint32_t>(session.watches()));
    one.set_views(static_cast<std::uint32_t>(session.views()));
  });
}

}  // namespace metamer::service
