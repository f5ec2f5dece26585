// Jobs: submitting, watching, listing and ordering them.
#include "server/service/net/dispatch.h"

#include "server/service/limits.h"

namespace metamer::service {

namespace {

tl::unexpected<Refusal> no_such_job(std::uint64_t id) {
  return refuse(v1::Error::NOT_FOUND, "there is no job " + std::to_string(id));
}

tl::unexpected<Refusal> too_long(const char* what, std::size_t bytes, std::size_t most) {
  return refuse(v1::Error::LIMIT, std::string(what) + " of " + std::to_string(bytes) +
                                      " bytes is over the limit of " + std::to_string(most));
}

/// What is said of a series is for people and for clients; it only has to be small and to make
/// sense.
tl::expected<void, Refusal> check_series(const v1::Series& series) {
  if (series.id().size() != series_id_bytes)
    return refuse(v1::Error::LIMIT, "a series' id has " + std::to_string(series_id_bytes) +
                                        " bytes, not " + std::to_string(series.id().size()));
  for (const std::string* text : {&series.name(), &series.label()})
    if (text->size() > max_series_text)
      return too_long(text == &series.name() ? "a series' name" : "the label of a series' job",
                      text->size(), max_series_text);
  if (series.count() > max_series_jobs)
    return refuse(v1::Error::LIMIT, "a series of " + std::to_string(series.count()) +
                                        " jobs is over the limit of " +
                                        std::to_string(max_series_jobs));
  if (series.index() >= series.count())
    return refuse(v1::Error::LIMIT, "a series of " + std::to_string(series.count()) +
                                        " has no job of index " + std::to_string(series.index()));
  return {};
}

tl::expected<void, Refusal> check_texts(const v1::Submit& submit) {
  if (submit.name().size() > max_job_name)
    return too_long("a job's name", submit.name().size(), max_job_name);
  if (submit.client_key().size() > max_client_key)
    return too_long("a key", submit.client_key().size(), max_client_key);
  return submit.has_series() ? check_series(submit.series()) : tl::expected<void, Refusal>();
}

}  // namespace

asio::awaitable<Dispatch::Answer> Dispatch::submit(v1::Submit submit) {
  if (context_.closing) co_return refuse(v1::Error::CLOSING, "the server ends and takes no jobs");
  if (auto fits = check_texts(submit); !fits) co_return tl::unexpected(fits.error());
  auto assets = hold(submit.scene_sha256(), submit.asset(), submit.backend());
  if (!assets) co_return tl::unexpected(assets.error());
  auto job = context_.queue.submit(std::move(submit), *std::move(assets), account_);
  if (!job) co_return tl::unexpected(job.error());
  if (const auto trouble = co_await kept(**job)) {
    if (context_.queue.cancel(**job)) context_.executor_of(**job).interrupt(**job);
    co_return tl::unexpected(*trouble);
  }
  context_.executor_of(**job).work();
  v1::Envelope envelope;
  envelope.mutable_submitted()->set_job_id((*job)->id());
  co_return envelope;
}

Dispatch::Answer Dispatch::watch(std::uint64_t request_id, const v1::Watch& watch) {
  const auto found = own_job(watch.job_id());
  if (!found) return tl::unexpected(found.error());
  const JobQueue::JobPtr& job = *found;
  if (watch.tiles()) {
    if (const auto found = job->find_tiles(); !found)
      return refuse(v1::Error::INTERNAL, "the picture of job " + std::to_string(job->id()) +
                                             " is damaged: " + found.error().message);
  }
  if (watches_.size() >= context_.limits.session_watches) {
    return refuse(v1::Error::LIMIT, "a client may watch " +
                                        std::to_string(context_.limits.session_watches) +
                                        " jobs at a time");
  }
  if (context_.closing) return refuse(v1::Error::CLOSING, "the server ends");
  watches_.add(request_id, watch, job);
  return std::nullopt;
}

Dispatch::Answer Dispatch::unwatch(const v1::Unwatch& unwatch) {
  if (!watches_.remove(unwatch.watch()))
    return refuse(v1::Error::NOT_FOUND,
                  "there is no watch " + std::to_string(unwatch.watch()) + ", or it has ended");
  v1::Envelope envelope;
  envelope.mutable_unwatched();
  return envelope;
}

Dispatch::Answer Dispatch::list(const v1::ListJobs& request) {
  context_.cpu.charge_job();
  context_.gl.charge_job();
  v1::Envelope envelope;
  *envelope.mutable_job_list() = context_.queue.list(request.after(), [&](const Job& job) {
    return sees(job) && (!request.mine() || job.owner() == account_);
  });
  return envelope;
}

/// Waits until what a job has come to is on the disk, where it is kept. Why it is not.
asio::awaitable<std::optional<Refusal>> Dispatch::kept(const Job& job) {
  if (!context_.state) co_return std::nullopt;
  Journal::Work nothing;
  (void)co_await context_.state->carry_out(std::move(nothing));
  if (!job.unkept()) co_return std::nullopt;
  const auto& trouble = context_.state->trouble();
  co_return Refusal{v1::Error::INTERNAL, "job " + std::to_string(job.id()) + " can't be kept: " +
                                             trouble.value_or("its tiles are lost")};
}

bool Dispatch::sees(const Job& job) const {
  return identity_->sees(job.owner() ? job.owner()->name : std::string());
}

/// A job that this client may know of: a stranger's is like one that never was.
tl::expected<JobQueue::JobPtr, Refusal> Dispatch::own_job(std::uint64_t id) const {
  auto job = context_.queue.find(id);
  if (!job || !sees(*job)) return no_such_job(id);
  return job;
}

asio::awaitable<Dispatch::Answer> Dispatch::order(Order order, std::uint64_t job_id) {
  const auto found = own_job(job_id);
  if (!found) co_return tl::unexpected(found.error());
  const JobQueue::JobPtr& job = *found;
  const auto carry_out = [&]() -> tl::expected<void, Refusal> {
    switch (order) {
      case Order::cancel:
        return context_.queue.cancel(*job);
      case Order::pause:
        return context_.queue.pause(*job);
      case Order::resume:
        return context_.queue.resume(job);
    }
    return {};
  };
  Executor& executor = context_.executor_of(*job);
  executor.charge_job();
  if (auto done = carry_out(); !done) co_return tl::unexpected(done.error());
  if (order != Order::resume) executor.interrupt(*job);
  executor.work();
  if (const auto trouble = co_await kept(*job)) co_return tl::unexpected(*trouble);
  v1::Envelope envelope;
  *envelope.mutable_job_summary() = job->summary();
  co_return envelope;
}

asio::awaitable<Dispatch::Answer> Dispatch::prioritize(const v1::Prioritize& request) {
  const auto job = own_job(request.job_id());
  if (!job) co_return tl::unexpected(job.error());
  if (auto done = context_.queue.prioritize(**job, request.priority()); !done)
    co_return tl::unexpected(done.error());
  if (const auto trouble = co_await kept(**job)) co_return tl::unexpected(*trouble);
  v1::Envelope envelope;
  *envelope.mutable_job_summary() = (*job)->summary();
  co_return envelope;
}

}  // namespace metamer::service
