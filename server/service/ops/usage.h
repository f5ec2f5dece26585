#pragma once

#include <string>

#include "metamer/v1/session.pb.h"
#include "server/service/jobs/job_queue.h"
#include "server/service/net/listener.h"

namespace metamer::service {

/// What each user has of what all share, in sessions and in the jobs that are listed, and has had
/// of the workers within a day. `only` names one; empty: everybody.
void add_users(const Listener& listener, const JobQueue& queue, Accounts& accounts,
               const std::string& only, v1::Info& info);
/// Who is on.
void add_sessions(const Listener& listener, v1::Info& info);

}  // namespace metamer::service
