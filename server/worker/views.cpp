#include "server/worker/views.h"

#include <algorithm>

namespace metamer {

Views::Views(const WorkerOptions& options, Link& link, Work& work, std::function<void()> wake)
    : options_(options), link_(link), work_(work), wake_(std::move(wake)) {}

Views::~Views() = default;

bool Views::take(const v1::WorkerEnvelope& message) {
  if (!message.has_open_view() && !message.has_update_view() && !message.has_next_frame() &&
      !message.has_close_view())
    return false;
  {
    const std::lock_guard lock(mutex_);
    messages_.push_back(message);
    waiting_ = true;
  }
  wake_();
  return true;
}

void Views::serve() {
  std::vector<v1::WorkerEnvelope> messages;
  {
    const std::lock_guard lock(mutex_);
    messages.swap(messages_);
  }
  for (const v1::WorkerEnvelope& message : messages) carry_out(message);
  std::erase_if(views_,
                [](const auto& view) { return view.second->has_work() && !view.second->turn(); });
  const bool more =
      std::any_of(views_.begin(), views_.end(), [](auto& view) { return view.second->has_work(); });
  const std::lock_guard lock(mutex_);
  waiting_ = more || !messages_.empty();
}

void Views::carry_out(const v1::WorkerEnvelope& message) {
  if (message.has_open_view()) {
    const std::uint64_t id = message.open_view().view_id();
    auto view = std::make_unique<View>(id, options_, link_, work_);
    if (view->open(message.open_view().open())) views_[id] = std::move(view);
    return;
  }
  const std::uint64_t id = message.has_update_view()  ? message.update_view().view_id()
                           : message.has_next_frame() ? message.next_frame().view_id()
                                                      : message.close_view().view_id();
  // One that has failed may still be spoken to: the daemon had not heard of it yet.
  const auto found = views_.find(id);
  if (found == views_.end()) return;
  if (message.has_next_frame()) return found->second->add_credit();
  if (message.has_update_view()) return found->second->update(message.update_view());
  views_.erase(found);
}

}  // namespace metamer
