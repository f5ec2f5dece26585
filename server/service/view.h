#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "metamer/v1/views.pb.h"
#include "metamer/v1/worker.pb.h"
#include "server/service/asset_store.h"
#include "server/service/refusal.h"

namespace metamer::service {

/// A view as the daemon knows it: what is on its way to its worker, and what waits for its client.
/// Neither grows: a client has at most max_frame_credits frames coming, and updates that come while
/// one is carried out become one.
class View {
 public:
  /// `wake` is called when next() may have something.
  View(std::uint64_t id, v1::OpenView open, AssetHolds assets, std::function<void()> wake);

  std::uint64_t id() const { return id_; }
  v1::Backend backend() const { return open_.backend(); }
  /// Nothing is to be said to it any more.
  bool ended() const { return ended_; }

  // What the worker is to be told; nothing: not yet.
  v1::WorkerEnvelope opening() const;
  v1::WorkerEnvelope closing() const;
  using Order = std::optional<v1::WorkerEnvelope>;
  /// Refused: what the store lacks; more than fits into one message.
  tl::expected<Order, Refusal> update(const v1::UpdateView& update);
  /// Refused: more frames than a client may have coming.
  tl::expected<Order, Refusal> next_frame();

  /// Takes what the worker says, and gives what it is to be told then. Error: it can't say that.
  tl::expected<Order, std::string> take(v1::ViewEvent event);
  /// Ends it; this is the last event.
  void end(v1::ViewClosed closed);

  /// The next event for its client.
  std::optional<v1::ViewEvent> next();

 private:
  tl::expected<void, std::string> check(const v1::FrameBand& band);
  void add(v1::ViewEvent event);
  Order send_waiting();

  std::uint64_t id_;
  v1::OpenView open_;
  AssetHolds assets_;
  std::function<void()> wake_;
  bool ended_ = false;
  bool answer_due_ = true;                 ///< Of the worker: to the opening, or to an update.
  std::optional<v1::UpdateView> waiting_;  ///< What came meanwhile, as one.
  unsigned coming_ = 0;                    ///< Frames asked for and not yet sent.
  unsigned due_ = 0;                       ///< Of these, those that the worker still has.
  std::uint32_t rows_ = 0;                 ///< Of the frame whose bands are coming.
  std::deque<v1::ViewEvent> unsent_;
};

/// Carries a later update over into an earlier one.
void merge(const v1::UpdateView& later, v1::UpdateView& into);

}  // namespace metamer::service
