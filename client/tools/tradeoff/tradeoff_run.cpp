#include "client/tools/tradeoff/tradeoff_run.h"

#include <utility>

#include "client/session/record_job.h"

namespace metamer::client {
namespace {

namespace asio = boost::asio;

using StepDone = tl::expected<void, TradeoffStop>;

tl::unexpected<TradeoffStop> session_stop(SessionError error) {
  return tl::unexpected<TradeoffStop>(
      {.kind = TradeoffStop::Kind::session, .error = std::move(error)});
}

/// Renders the job that is due. A refusal is told to the steps.
asio::awaitable<StepDone> run_step(Session& session, const Submission& submission,
                                   const TradeoffCalls& calls, TradeoffSteps& steps) {
  Answer<std::uint64_t> job_id = co_await session.submit(submission);
  if (!job_id && job_id.error().kind == SessionError::Kind::refused)
    co_return steps.refused(job_id.error().message);
  if (!job_id) co_return session_stop(std::move(job_id.error()));

  calls.job(*job_id);
  Answer<JobRecord> job = co_await record_job(session, *job_id, JobParts::picture);
  calls.job({});
  if (!job) co_return session_stop(std::move(job.error()));
  co_return steps.ended(*job);
}

}  // namespace

asio::awaitable<tl::expected<Tradeoff, TradeoffStop>> run_tradeoff(Session& session,
                                                                   const TradeoffScene& scene,
                                                                   unsigned rounds,
                                                                   const TradeoffCalls& calls) {
  TradeoffSteps steps(scene, rounds, calls.measured);
  std::optional<unsigned> told;
  while (const std::optional<Submission> submission = steps.next()) {
    if (told != steps.round()) calls.round(steps.round(), steps.so_far());
    told = steps.round();
    StepDone done = co_await run_step(session, *submission, calls, steps);
    if (!done) co_return tl::unexpected<TradeoffStop>(std::move(done.error()));
  }
  co_return tl::expected<Tradeoff, TradeoffStop>(steps.so_far());
}

}  // namespace metamer::client
