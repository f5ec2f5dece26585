#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "metamer/v1/views.pb.h"
#include "metamer/v1/worker.pb.h"
#include "server/service/assets/asset_store.h"
#include "server/service/refusal.h"
#include "server/service/schedule/admission.h"

namespace metamer::service {

/// A view as the daemon knows it: what is on its way to its worker, and what waits for its client.
/// Neither grows: a client has at most max_frame_credits frames coming, updates that come while one
/// is carried out become one, and of more than max_probes probes the oldest give way.
class View {
 public:
  /// `wake` is called when next() may have something.
  View(std::uint64_t id, v1::OpenView open, AssetHolds assets, std::function<void()> wake);

  std::uint64_t id() const { return id_; }
  v1::Backend backend() const { return open_.backend(); }
  /// Nothing is to be said to it any more.
  bool ended() const { return ended_; }

  /// Of what is shown, and of a scene that the worker has been told of.
  std::vector<const AssetHolds*> assets() const;
  /// What says how much memory it takes: as the newest plan has it, or before that by its files.
  JobSize size() const { return size_; }
  /// The same with another scene, before there is a plan.
  static JobSize size_of(const AssetHolds& assets, const std::string& scene_sha256);
  /// The same with a plan that its worker has made.
  JobSize size_with(const v1::Plan& plan) const;
  /// Bytes, by estimate; with those of another scene that it has been told of.
  std::uint64_t memory() const;
  /// The worker's next answer says which of these go.
  bool changes_scene() const { return sent_assets_ != nullptr; }

  // What the worker is to be told; nothing: not yet.
  v1::WorkerEnvelope opening() const;
  v1::WorkerEnvelope closing() const;
  /// What was asked for while there was no worker to hear it.
  std::vector<v1::WorkerEnvelope> frames_due() const;
  using Order = std::optional<v1::WorkerEnvelope>;
  /// `scene`: what an update with another scene holds. Refused: what the store lacks; more than
  /// fits into one message.
  tl::expected<Order, Refusal> update(const v1::UpdateView& update,
                                      std::unique_ptr<AssetHolds> scene = {});
  /// Refused: more frames than a client may have coming.
  tl::expected<Order, Refusal> next_frame(bool xyz = false);
  /// Refused: a place outside the picture.
  tl::expected<Order, Refusal> probe(const v1::Probe& probe);

  /// Takes what the worker says, and gives what it is to be told then. Error: it can't say that.
  tl::expected<Order, std::string> take(v1::ViewEvent event);
  /// Ends it; this is the last event.
  void end(v1::ViewClosed closed);

  /// The next event for its client.
  std::optional<v1::ViewEvent> next();

 private:
  tl::expected<void, std::string> check(const v1::FrameBand& band);
  tl::expected<void, Refusal> hold(const v1::AssetName& asset);
  tl::expected<Order, std::string> take_probed(v1::ViewEvent event);
  void add(v1::ViewEvent event);
  Order send_waiting();
  Order send_probe();

  std::uint64_t id_;
  v1::OpenView open_;
  std::unique_ptr<AssetHolds> assets_;                        ///< Of what is shown;
  std::unique_ptr<AssetHolds> sent_assets_, waiting_assets_;  ///< of a scene that may be, or null.
  JobSize size_;                                              ///< Of what is shown,
  JobSize sent_size_, waiting_size_;                          ///< and of these.
  std::function<void()> wake_;
  bool ended_ = false;
  bool answer_due_ = true;                 ///< Of the worker: to the opening, or to an update.
  std::optional<v1::UpdateView> waiting_;  ///< What came meanwhile, as one.
  unsigned coming_ = 0;                    ///< Frames asked for and not yet sent.
  std::deque<bool> due_;    ///< Of these, those that the worker still has: with X Y Z?
  std::uint32_t rows_ = 0;  ///< Of the frame whose bands are coming.
  bool has_xyz_ = false;    ///< So does that frame.
  std::uint32_t width_ = 0, height_ = 0;  ///< Of a complete frame, as the newest plan has it.
  std::deque<v1::Probe> probes_;          ///< Unanswered; at most max_probes.
  bool probe_due_ = false;                ///< The worker has the first of them.
  std::deque<v1::ViewEvent> unsent_;
};

/// Carries a later update over into an earlier one. Of that, another scene leaves nothing.
void merge(const v1::UpdateView& later, v1::UpdateView& into);

}  // namespace metamer::service
