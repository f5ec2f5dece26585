#include "server/worker/views.h"

#include <algorithm>
#include <future>

namespace metamer::worker {

Views::Views(const WorkerOptions& options, Link& link, Work& work, std::function<void()> wake)
    : options_(options), link_(link), work_(work), wake_(std::move(wake)) {}

Views::~Views() = default;

bool Views::take(const v1::WorkerEnvelope& message) {
  if (!message.has_open_view() && !message.has_update_view() && !message.has_next_frame() &&
      !message.has_probe() && !message.has_close_view())
    return false;
  {
    const std::lock_guard lock(mutex_);
    messages_.push_back(message);
  }
  call();
  return true;
}

/// From any thread: there is something to serve.
void Views::call() {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = called_since_ = true;
  }
  called_.notify_all();
  wake_();
}

void Views::serve() {
  std::vector<v1::WorkerEnvelope> messages;
  {
    const std::lock_guard lock(mutex_);
    messages.swap(messages_);
    called_since_ = false;
  }
  const std::uint64_t work_before = work_;
  for (const v1::WorkerEnvelope& message : messages) carry_out(message);
  std::erase_if(views_,
                [](const auto& view) { return view.second->has_work() && !view.second->turn(); });
  std::erase_if(closed_, [](const auto& view) { return !view->is_importing(); });
  const auto any = [&](bool (View::*has)() const) {
    return std::any_of(views_.begin(), views_.end(),
                       [&](const auto& view) { return ((*view.second).*has)(); });
  };
  importing_ = any(&View::is_importing) || !closed_.empty();
  // Who watches for a hang shall not be told of frames, while it is the import that hangs.
  if (importing_ || aside_) work_ = work_before;
  const bool more = any(&View::has_work);
  const std::lock_guard lock(mutex_);
  waiting_ = more || called_since_;
}

void Views::serve_while(const std::function<void()>& work) {
  aside_ = true;
  std::atomic<bool> done = false;
  auto result = std::async(std::launch::async, [&] {
    struct Last {  // also where something is thrown
      Views& views;
      std::atomic<bool>& done;
      ~Last() {
        done = true;
        views.call();
      }
    } const last{*this, done};
    work();
  });
  while (!done) {
    {
      std::unique_lock lock(mutex_);
      called_.wait(lock, [&] { return waiting_.load(); });
    }
    serve();
  }
  aside_ = false;
  result.get();
}

void Views::carry_out(const v1::WorkerEnvelope& message) {
  if (message.has_open_view()) {
    const std::uint64_t id = message.open_view().view_id();
    auto view = std::make_unique<View>(id, options_, link_, work_, [this] { call(); });
    if (view->open(message.open_view().open())) views_[id] = std::move(view);
    return;
  }
  const std::uint64_t id = message.has_update_view()  ? message.update_view().view_id()
                           : message.has_next_frame() ? message.next_frame().view_id()
                           : message.has_probe()      ? message.probe().view_id()
                                                      : message.close_view().view_id();
  // One that has failed may still be spoken to: the daemon had not heard of it yet.
  const auto found = views_.find(id);
  if (found == views_.end()) return;
  if (message.has_next_frame()) return found->second->add_credit(message.next_frame().xyz());
  if (message.has_probe()) return found->second->probe(message.probe());
  if (message.has_update_view()) return found->second->update(message.update_view());
  if (found->second->is_importing()) {
    found->second->cancel_import();
    closed_.push_back(std::move(found->second));
  }
  views_.erase(found);
}

}  // namespace metamer::worker
