#include "server/service/net/watches.h"

#include <algorithm>

namespace metamer::service {

void Watches::add(std::uint64_t request_id, const v1::Watch& request, const JobQueue::JobPtr& job) {
  Watch watch;
  watch.request_id = request_id;
  watch.watcher = std::make_unique<Job::Watcher>(job, request.previews(), wake_);
  watch.from = std::max<std::uint64_t>(request.from_sequence(), 1);
  watch.factors = request.factors();
  watch.filter = {request.tiles(), request.previews()};
  watches_.push_back(std::move(watch));
}

bool Watches::remove(std::uint64_t request_id) {
  const auto is_it = [&](const Watch& watch) { return watch.request_id == request_id; };
  return std::erase_if(watches_, is_it) > 0;
}

void Watches::close(const std::string& message) {
  closing_ = message;
  for (Watch& watch : watches_) watch.last = watch.watcher->job().log().last_sequence();
  wake_();
}

std::optional<v1::Envelope> Watches::next() {
  for (std::size_t asked = 0; asked < watches_.size(); ++asked) {
    turn_ = (turn_ + 1) % watches_.size();
    Watch& watch = watches_[turn_];
    const Job& job = watch.watcher->job();
    const EventLog& log = job.log();
    const auto entry = log.next(watch.from, watch.filter);
    const bool told_all = closing_ && (!entry || entry->sequence > watch.last);
    if (!entry && !told_all) continue;

    v1::Envelope envelope;
    envelope.set_request_id(watch.request_id);
    if (told_all) {
      envelope.mutable_error()->set_code(v1::Error::CLOSING);
      envelope.mutable_error()->set_message("job " + std::to_string(job.id()) + ": " + *closing_);
      watches_.erase(watches_.begin() + static_cast<std::ptrdiff_t>(turn_));
      return envelope;
    }
    if (!entry->event && job.picture_dropped()) {
      envelope.mutable_error()->set_code(v1::Error::LIMIT);
      envelope.mutable_error()->set_message("the picture of job " + std::to_string(job.id()) +
                                            " was dropped before it was read");
      watches_.erase(watches_.begin() + static_cast<std::ptrdiff_t>(turn_));
      return envelope;
    }
    auto event = job.event(*entry, watch.factors);
    if (!event) {
      envelope.mutable_error()->set_code(v1::Error::INTERNAL);
      envelope.mutable_error()->set_message("the picture of job " + std::to_string(job.id()) +
                                            " is damaged: " + event.error().message);
      watches_.erase(watches_.begin() + static_cast<std::ptrdiff_t>(turn_));
      return envelope;
    }
    *envelope.mutable_job_event() = *std::move(event);
    watch.from = entry->sequence + 1;
    if (log.ended() && entry->sequence == log.last_sequence()) {
      watches_.erase(watches_.begin() + static_cast<std::ptrdiff_t>(turn_));
    }
    return envelope;
  }
  return std::nullopt;
}

}  // namespace metamer::service
