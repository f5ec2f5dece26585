#include "server/service/store/journal.h"

#include <spdlog/spdlog.h>

#include <system_error>
#include <utility>

#include "server/service/store/disk_trouble.h"
#include "server/service/store/durable_file.h"

namespace metamer::service {

Journal::Journal(asio::any_io_executor loop, std::unique_ptr<Database> database)
    : loop_(std::move(loop)), database_(std::move(database)), thread_([this] { run(); }) {}

Journal::~Journal() {
  {
    const std::lock_guard guard(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Journal::post(Work work, Done done) {
  {
    const std::lock_guard guard(mutex_);
    waiting_.push_back({std::move(work), std::move(done), {}});
  }
  wake_.notify_one();
}

asio::awaitable<std::optional<StoreTrouble>> Journal::carry_out(Work work) {
  asio::steady_timer signal(co_await asio::this_coro::executor,
                            asio::steady_timer::time_point::max());
  // Shared: the one who waits may be gone when the work is done.
  auto outcome = std::make_shared<std::optional<std::optional<StoreTrouble>>>();
  const auto wake = std::make_shared<asio::steady_timer*>(&signal);
  post(std::move(work), [outcome, wake](const std::optional<StoreTrouble>& trouble) {
    *outcome = trouble;
    if (*wake) (*wake)->cancel();
  });
  struct Forget {
    std::shared_ptr<asio::steady_timer*> wake;
    ~Forget() { *wake = nullptr; }
  } const forget{wake};
  while (!*outcome) co_await signal.async_wait(asio::as_tuple(asio::use_awaitable));
  co_return **outcome;
}

void Journal::run() {
  for (;;) {
    std::vector<Entry> batch;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return stopping_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      batch.swap(waiting_);
    }
    write(batch);
    finish(std::move(batch));
  }
}

/// All in one transaction; where that fails each in its own, so that the one at fault fails alone.
void Journal::write(std::vector<Entry>& batch) {
  if (batch.size() > 1 && !broken_) {
    try {
      Database::Transaction transaction(*database_);
      for (const Entry& entry : batch)
        if (entry.work) entry.work(*database_);
      transaction.commit();
      return;
    } catch (const std::exception& error) {
      spdlog::debug("a transaction of {} is tried piece by piece: {}", batch.size(), error.what());
    }
  }
  for (Entry& entry : batch) write_one(entry);
}

void Journal::write_one(Entry& entry) {
  do {
    entry.trouble = try_one(entry);
  } while (entry.trouble && entry.trouble->wants_room && ask_for_room());
}

std::optional<StoreTrouble> Journal::try_one(const Entry& entry) {
  if (broken_) return broken_;
  try {
    Database::Transaction transaction(*database_);
    if (entry.work) entry.work(*database_);
    transaction.commit();
    return std::nullopt;
  } catch (const DatabaseError& error) {
    const StoreTrouble trouble{error.what(), error.may_pass(), error.is_full()};
    // After a failed sync nobody knows what is on the disk: what is written later could rest on
    // something that is not.
    if (error.is_broken()) broken_ = trouble;
    return trouble;
  } catch (const SyncError& error) {
    return StoreTrouble{error.code().message(), is_want_of_room(error.code().value())};
  } catch (const std::system_error& error) {
    const bool full = is_want_of_room(error.code().value());
    return StoreTrouble{error.code().message(), full, full};
  } catch (const std::exception& error) {
    return StoreTrouble{error.what()};
  }
}

/// Waits for the loop's answer; what comes later waits, too, for all is written in order. No room
/// is made for a journal that ends: nobody runs the loop then.
bool Journal::ask_for_room() {
  {
    const std::lock_guard guard(mutex_);
    room_made_.reset();
  }
  asio::post(loop_, [this, alive = std::weak_ptr(alive_)] {
    if (alive.expired()) return;
    const bool made = make_room_ && make_room_();
    const std::lock_guard guard(mutex_);
    room_made_ = made;
    wake_.notify_one();
  });
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [&] { return stopping_ || room_made_; });
  return room_made_.value_or(false);
}

void Journal::finish(std::vector<Entry> batch) {
  asio::post(loop_, [this, alive = std::weak_ptr(alive_), batch = std::move(batch)] {
    if (alive.expired()) return;
    ++commits_;
    for (const Entry& entry : batch)
      if (entry.done) entry.done(entry.trouble);
  });
}

}  // namespace metamer::service
