#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "metamer/v1/envelope.pb.h"
#include "server/service/views/views.h"

namespace metamer::service {

/// The views that one session has open, and the request under which each is answered.
class ViewStreams {
 public:
  /// `wake` is called when next() may have something; `close` when a view is no longer wanted.
  ViewStreams(std::function<void()> wake, std::function<void(View&)> close)
      : wake_(std::move(wake)), close_(std::move(close)) {}

  std::size_t size() const { return streams_.size(); }
  const std::function<void()>& wake() const { return wake_; }
  void add(std::uint64_t request_id, ViewPtr view) {
    streams_.push_back({request_id, std::move(view)});
  }
  /// Null: this session has no such view.
  ViewPtr find(std::uint64_t view_id) const;
  void clear();

  /// The next event of one of the views, in turns; nothing when none has one. A view goes with its
  /// last event.
  std::optional<v1::Envelope> next();

 private:
  struct Stream {
    std::uint64_t request_id;
    ViewPtr view;
  };

  std::function<void()> wake_;
  std::function<void(View&)> close_;
  std::vector<Stream> streams_;
  std::size_t turn_ = 0;
};

}  // namespace metamer::service
