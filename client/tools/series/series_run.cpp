#include "client/tools/series/series_run.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/this_coro.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <utility>

#include "client/session/record_job.h"

namespace metamer::client {

namespace asio = boost::asio;

namespace {

/// More than a cluster's nodes are kept busy by, each job being many tasks; each is a watch of the
/// session.
constexpr std::size_t enough_submitted = 16;
/// Seconds to wait for room that others take.
constexpr unsigned most_refusals = 60;

}  // namespace

std::string series_id() {
  std::array<char, 16> bytes{};
  // It fails for more than 256 bytes, and on systems that Metamer does not run on.
  if (getentropy(bytes.data(), bytes.size()) != 0) std::abort();
  return {bytes.begin(), bytes.end()};
}

std::string series_digits(const std::string& id) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const char c : id) {
    const auto byte = static_cast<unsigned char>(c);
    text += {digits[byte >> 4], digits[byte & 15]};
  }
  return text;
}

std::string series_handle(const std::string& id) {
  return "series:" + series_digits(id).substr(0, 8);
}

std::size_t SeriesRun::most_submitted() const {
  const v1::Limits& limits = session_.welcome().limits();
  const std::uint64_t watches = std::max(1u, limits.watches());
  return std::min({enough_submitted, static_cast<std::size_t>(watches),
                   static_cast<std::size_t>(std::max<std::uint64_t>(1, limits.queued_jobs()))});
}

bool SeriesRun::may_submit() const {
  return next_ < counts_.count && submitted_.size() < most_submitted() &&
         std::none_of(submitted_.begin(), submitted_.end(),
                      [](const auto& one) { return one.second.paused; });
}

asio::awaitable<Answer<SeriesCounts>> SeriesRun::run() {
  const auto executor = co_await asio::this_coro::executor;
  news_.emplace(executor);
  tell();
  for (;;) {
    const bool goes_on = !cancelled_ && !lost_;
    if (goes_on && may_submit()) {
      const Next next = co_await submit_next();
      if (next == Next::go_on) continue;
      co_await wait(std::chrono::seconds(1));
      continue;
    }
    if (submitted_.empty() && (!goes_on || next_ == counts_.count)) break;
    co_await wait(std::chrono::hours(1));
  }
  if (lost_) co_return tl::unexpected<SessionError>(*lost_);
  co_return Answer<SeriesCounts>(counts_);
}

asio::awaitable<SeriesRun::Next> SeriesRun::submit_next() {
  const std::uint32_t index = next_;
  if (!due_) {
    Result<Submission> made = calls_.make(index);
    if (!made) {
      ++next_;
      end(index, tl::unexpected<Problem>(std::move(made.error())));
      co_return Next::go_on;
    }
    due_ = std::move(*made);
    v1::Series& series = *due_->request.mutable_series();
    series.set_id(jobs_.id);
    series.set_name(jobs_.name);
    series.set_index(index);
    series.set_count(counts_.count);
    series.set_label(calls_.label(index));
    due_->request.set_keep_factors(jobs_.parts == JobParts::picture_and_factors);
  }
  const std::size_t before = submitted_.size();
  const Answer<std::uint64_t> job_id = co_await session_.submit(*due_);
  if (!job_id) {
    const SessionError& error = job_id.error();
    const bool refused = error.kind == SessionError::Kind::refused;
    const bool wants_room = refused && error.code == v1::Error::LIMIT;
    if (wants_room && submitted_.size() < before) co_return Next::go_on;  // there is some now
    if (wants_room && (!submitted_.empty() || ++refusals_ <= most_refusals)) co_return Next::wait;
    if (session_.lost() || error.kind == SessionError::Kind::disconnected) {
      lost_ = error;
      co_return Next::go_on;
    }
    due_.reset();
    ++next_;
    end(index, problem(error.message));
    co_return Next::go_on;
  }
  due_.reset();
  refusals_ = 0;
  ++next_;
  submitted_[index].job_id = *job_id;
  tell();
  const auto executor = co_await asio::this_coro::executor;
  asio::co_spawn(executor, follow(index, *job_id), asio::detached);
  if (cancelled_) asio::co_spawn(executor, session_.cancel(*job_id), asio::detached);
  co_return Next::go_on;
}

asio::awaitable<void> SeriesRun::follow(std::uint32_t index, std::uint64_t job_id) {
  const std::function<void(const v1::JobEvent&)> show = [this, index](const v1::JobEvent& event) {
    shown(index, event);
  };
  Answer<JobRecord> record = co_await record_job(session_, job_id, jobs_.parts, show);
  submitted_.erase(index);
  if (!record && (session_.lost() || record.error().kind == SessionError::Kind::disconnected)) {
    lost_ = std::move(record.error());
  } else if (!record) {
    end(index, problem(record.error().message));
  } else {
    if (record->last.has_cancelled() && !cancelled_) cancel();
    end(index, SeriesEnd(std::move(*record)));
  }
  news_->cancel();
}

asio::awaitable<void> SeriesRun::wait(std::chrono::steady_clock::duration most) {
  news_->expires_after(most);
  boost::system::error_code ignored;
  co_await news_->async_wait(asio::redirect_error(asio::use_awaitable, ignored));
}

void SeriesRun::shown(std::uint32_t index, const v1::JobEvent& event) {
  Submitted& job = submitted_[index];
  const bool was_paused = job.paused;
  if (event.has_paused()) job.paused = true;
  if (event.has_queued() || event.has_started()) job.paused = false;
  if (was_paused && !job.paused) news_->cancel();
  if (!event.has_progress()) return;
  job.share = event.progress().tiles() > 0
                  ? static_cast<double>(event.progress().tiles_done()) / event.progress().tiles()
                  : 0;
  tell();
}

void SeriesRun::end(std::uint32_t index, SeriesEnd end) {
  const bool cancelled = end && end->last.has_cancelled();
  ++(end && end->last.has_finished() ? counts_.done
     : cancelled                     ? counts_.cancelled
                                     : counts_.failed);
  calls_.ended(index, std::move(end));
  tell();
}

void SeriesRun::cancel() {
  cancelled_ = true;
  for (const auto& [index, job] : submitted_)
    asio::co_spawn(news_->get_executor(), session_.cancel(job.job_id), asio::detached);
  news_->cancel();
}

void SeriesRun::tell() {
  counts_.submitted = static_cast<std::uint32_t>(submitted_.size());
  double sum = counts_.done + counts_.failed + counts_.cancelled;
  for (const auto& [index, job] : submitted_) sum += job.share;
  counts_.share = counts_.count > 0 ? sum / counts_.count : 1;
  calls_.progress(counts_);
}

}  // namespace metamer::client
