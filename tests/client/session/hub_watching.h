#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "client/session/hub.h"
#include "client/session/live_view.h"
#include "fake_server.h"

/// A hub beside a server that does what a test says, and what came of it.
namespace metamer::test {

/// What came on the hub's thread, to be waited for on the test's.
template <class T>
class Came {
 public:
  void add(T one) {
    const std::lock_guard guard(mutex_);
    all_.push_back(std::move(one));
    changed_.notify_all();
  }
  /// Whether `holds` is true of what came, within 10 s.
  bool wait(const std::function<bool(const std::vector<T>&)>& holds) {
    std::unique_lock guard(mutex_);
    return changed_.wait_for(guard, std::chrono::seconds(10), [&] { return holds(all_); });
  }
  std::vector<T> all() {
    const std::lock_guard guard(mutex_);
    return all_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<T> all_;
};

inline bool is_last(const std::vector<LinkStatus>& all, LinkStatus::Kind kind) {
  return !all.empty() && all.back().kind == kind;
}

/// Answers as a server with a view does: each frame of the revision that was told last, complete
/// with its `samples`-th frame.
class ViewAnswers {
 public:
  static constexpr std::uint32_t never_complete = ~0u;

  explicit ViewAnswers(std::uint32_t samples) : samples_(samples) {}

  std::vector<v1::Envelope> operator()(const v1::Envelope& request) {
    v1::Envelope answer;
    switch (request.body_case()) {
      case v1::Envelope::kHello:
        return {welcome()};
      case v1::Envelope::kPing:
        answer.mutable_pong();
        return {answer};
      case v1::Envelope::kOfferAssets:
        answer.mutable_missing_assets();
        return {answer};
      case v1::Envelope::kOpenView:
        opened.add(request.open_view());
        revision_ = 0;
        done_ = 0;
        held_ = 0;
        answer.mutable_view_event()->mutable_updated()->mutable_plan()->set_spp(samples_);
        return {answer};
      case v1::Envelope::kUpdateView:
        changes.add(request.update_view());
        revision_ = request.update_view().revision();
        done_ = 0;
        if (refuse) {
          answer.mutable_view_event()->mutable_refused()->set_revision(revision_);
          return {answer};
        }
        answer.mutable_view_event()->mutable_updated()->set_revision(revision_);
        if (replaces && !request.update_view().scene_sha256().empty())
          answer.mutable_view_event()->mutable_updated()->mutable_plan()->set_spp(samples_);
        return with_held_frames(answer);
      case v1::Envelope::kNextFrame: {
        if (close_for != v1::Failed::UNSPECIFIED) {
          v1::Failed& why = *answer.mutable_view_event()->mutable_closed()->mutable_reason();
          why.set_kind(close_for);
          why.set_reason("signal 9");
          if (close_once) close_for = v1::Failed::UNSPECIFIED;
          return {answer};
        }
        asked.add(1);
        if (hold_frames && done_ >= samples_) {
          ++held_;
          return {};
        }
        return {frame(request.next_frame().xyz())};
      }
      case v1::Envelope::kProbe: {
        probes.add(request.probe());
        if (!knows_probes) return {error(v1::Error::UNKNOWN_MESSAGE, "what is that")};
        if (hold_probes) return {};
        v1::Probed& probed = *answer.mutable_view_event()->mutable_probed();
        probed.set_number(request.probe().number());
        probed.add_xyz(request.probe().x());
        probed.add_xyz(request.probe().y());
        probed.add_xyz(request.probe().side());
        return {answer};
      }
      case v1::Envelope::kCloseView:
        answer.mutable_view_event()->mutable_closed();
        closed.add(1);
        return {answer};
      default:
        return {v1::Envelope()};
    }
  }

  Came<v1::UpdateView> changes;
  Came<v1::Probe> probes;
  Came<v1::OpenView> opened;
  Came<int> asked, closed;
  std::atomic<bool> refuse = false;
  bool knows_probes = true, hold_probes = false;
  bool replaces = true;      ///< Knows UpdateView.scene_sha256.
  bool hold_frames = false;  ///< Those that are asked for once the picture is complete.
  /// Why the view is closed at the next frame that is asked for.
  std::atomic<v1::Failed::Kind> close_for = v1::Failed::UNSPECIFIED;
  bool close_once = false;

 private:
  v1::Envelope frame(bool xyz) {
    v1::Envelope answer;
    v1::FrameBand& band = *answer.mutable_view_event()->mutable_band();
    band.set_width(1);
    band.set_height(1);
    band.set_rgb("abc");
    band.mutable_frame()->set_revision(revision_);
    band.mutable_frame()->set_samples(std::min(++done_, samples_));
    band.mutable_frame()->set_complete(done_ >= samples_);
    if (xyz && done_ >= samples_) band.set_xyz(std::string(3 * sizeof(float), '\0'));
    return answer;
  }
  std::vector<v1::Envelope> with_held_frames(const v1::Envelope& first) {
    std::vector<v1::Envelope> all{first};
    for (; held_ > 0 && done_ < samples_; --held_) all.push_back(frame(false));
    return all;
  }

  std::uint32_t samples_, done_ = 0, held_ = 0;
  std::uint64_t revision_ = 0;
};

/// A hub with a session, and a view of it.
struct Watching {
  explicit Watching(const std::string& server)
      : hub([this](const LinkStatus& status) { statuses.add(status); }) {
    hub.open(server);
    EXPECT_TRUE(
        statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::ready); }));
    ViewHooks hooks;
    hooks.frame = [this](const ViewFrame& frame) {
      frames.add(frame.frame);
      if (!frame.xyz.empty()) xyz.add(frame.frame);
      if (takes) view->taken();
    };
    hooks.refused = [this](const SessionError& error) { refusals.add(error); };
    hooks.interrupted = [this](const SessionError& error) { interruptions.add(error); };
    hooks.lost = [this](const SessionError& error) { losses.add(error); };
    hooks.probed = [this](const ViewPlace& place, const Answer<v1::Probed>& answer) {
      answer ? probed.add({place, *answer}) : unprobed.add(answer.error());
    };
    view = hub.view(Submission(), std::move(hooks));
  }
  /// From now on each frame is taken as it comes, as a window does that draws at once. What is told
  /// after a number of frames that nobody counted needs this: a frame can be taken only once it has
  /// come. The view stays open to the end.
  void take_each() {
    takes = true;
    for (int i = 0; i < LiveView::most_frames; ++i) view->taken();  // those that came before
  }

  Came<LinkStatus> statuses;
  Came<v1::Frame> frames, xyz;
  Came<SessionError> refusals, interruptions, losses, unprobed;
  Came<std::pair<ViewPlace, v1::Probed>> probed;
  std::atomic<bool> takes = false;
  std::shared_ptr<HubView> view;  ///< Outlives the hub's thread, which may be taking a frame.
  SessionHub hub;
};

}  // namespace metamer::test
