#include "client/session/record_job.h"

#include <utility>

namespace metamer::client {

namespace asio = boost::asio;

asio::awaitable<Answer<JobRecord>> record_job(Session& session, std::uint64_t job_id,
                                              JobParts parts,
                                              std::function<void(const v1::JobEvent&)> shown,
                                              std::stop_token stop) {
  JobRecord record;
  record.job = {.number = job_id, .server = server_digits(session.welcome())};
  std::uint64_t next = 0;
  Answer<void> ended =
      co_await record_on(session, record, next, parts, std::move(shown), std::move(stop));
  if (!ended) co_return tl::unexpected<SessionError>(std::move(ended.error()));
  co_return Answer<JobRecord>(std::move(record));
}

asio::awaitable<Answer<void>> record_on(Session& session, JobRecord& record, std::uint64_t& next,
                                        JobParts parts,
                                        std::function<void(const v1::JobEvent&)> shown,
                                        std::stop_token stop) {
  if (Answer<void> known = check_server(record.job, session.welcome()); !known) co_return known;
  v1::Watch request;
  request.set_job_id(record.job.number);
  request.set_from_sequence(next);
  request.set_tiles(parts != JobParts::plan);
  request.set_factors(parts == JobParts::picture_and_factors);

  Session::OnEvent on_event = [&](const v1::JobEvent& event) {
    next = event.sequence() + 1;
    if (shown) shown(event);
    return take(event, parts, record);
  };
  Answer<void> ended = co_await session.watch(std::move(request), on_event, std::move(stop));
  if (ended) ended = complete(record, parts);
  co_return ended;
}

}  // namespace metamer::client
