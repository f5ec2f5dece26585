#pragma once

#include <boost/asio/awaitable.hpp>
#include <cstdint>
#include <functional>
#include <stop_token>

#include "client/session/job_record.h"
#include "client/session/session.h"

namespace metamer::client {

/// Watches a job from its first event to its last and records it. Each event is given to `shown`
/// before it is taken. `stop` ends it as it ends Session::watch: the record then has no last event.
/// Errors: those of Session::watch, take and complete.
boost::asio::awaitable<Answer<JobRecord>> record_job(
    Session& session, std::uint64_t job_id, JobParts parts,
    std::function<void(const v1::JobEvent&)> shown = {}, std::stop_token stop = {});

/// Goes on with a record whose session was lost, from the event `next` (0: the first), as
/// record_job does; `next` becomes the number after the last event that was taken. Error, input:
/// the session is with another server than the job's; nothing is asked of it.
boost::asio::awaitable<Answer<void>> record_on(Session& session, JobRecord& record,
                                               std::uint64_t& next, JobParts parts,
                                               std::function<void(const v1::JobEvent&)> shown,
                                               std::stop_token stop);

}  // namespace metamer::client
