#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/worker.pb.h"
#include "server/film/develop.h"
#include "server/film/sample_pattern.h"
#include "server/methods/method.h"
#include "server/worker/job.h"
#include "server/worker/view_probe.h"

namespace metamer::worker {

/// A scene that a client looks at and changes. Keeps everything that a change leaves as it is:
/// after a camera only frames are drawn, after a light or a material their tables are made anew,
/// and geometry only where objects would look different. Belongs to the lane's thread.
class View {
 public:
  using Problems = ViewScene::Problems;

  /// `wake` is called from any thread when it has something to do that nobody sent.
  View(std::uint64_t id, const WorkerOptions& options, Link& link, Work& work,
       std::function<void()> wake);
  ~View();

  /// Begins to import the scene, or sends Closed and why: then false.
  bool open(const v1::OpenView& message);
  /// Keeps it for the next turn; none comes before the last one was answered.
  void update(const v1::UpdateView& message) { update_ = message; }
  /// Answered in its turn, after an update that waits.
  void probe(const v1::Probe& message) { probes_.push_back(message); }
  void add_credit(bool xyz = false) { credits_.push_back(xyz); }

  /// Its scene is being imported, on a thread of its own: until then it has no work.
  bool is_importing() const { return scene_.is_importing() && !scene_.is_imported(); }
  /// The import is of no use to anybody.
  void cancel_import() { scene_.cancel_import(); }
  bool has_work() const {
    return scene_.is_importing() ? scene_.is_imported()
                                 : update_ || !probes_.empty() || has_frame();
  }
  /// Takes what was imported, or carries out the update; either sends Updated, or Refused and the
  /// view stays as it was. Then draws at the next frame for about a frame's time, and sends it in
  /// bands once it is whole. False: the view is lost, and Closed was sent.
  bool turn();

 private:
  using Clock = std::chrono::steady_clock;

  bool has_frame() const { return !credits_.empty() && (drawn_ < pattern_.size() || owes_xyz()); }
  /// They are asked for once the frame is complete.
  bool owes_xyz() const {
    return !xyz_sent_ && std::find(credits_.begin(), credits_.end(), true) != credits_.end();
  }
  /// Its first frame is drawn to its end, or a stream of updates would show nothing.
  bool is_first_under_way() const { return under_way_ && drawn_ == 0; }
  bool change(const v1::UpdateView& message);
  bool adopt();
  bool prepare();
  void begin_anew();
  bool draw();
  void send_frame(std::uint32_t width, std::uint32_t height);
  void send_bands(std::uint32_t width, std::uint32_t height, const v1::Frame& frame, bool xyz);
  void send_updated(bool planned);
  void answer_probes();
  bool refuse(std::uint64_t revision, const Problems& problems);
  void send_closed(const v1::Failed& reason);
  v1::WorkerEnvelope event() const;

  std::uint64_t id_;
  const WorkerOptions& options_;
  Link& link_;
  Work& work_;

  ViewScene scene_;
  ViewProbe view_probe_;  ///< Of that scene.
  v1::Plan plan_;
  std::unique_ptr<Method> method_;  ///< Null: not yet open.
  std::optional<Developer> developer_;

  std::uint64_t revision_ = 0;
  std::uint64_t asked_revision_ = 0;  ///< Of the change that is being carried out,
  Clock::time_point begun_;           ///< since then.
  v1::Timing timing_;                 ///< What it took.
  std::deque<bool> credits_;          ///< Frames asked for, and whether with X Y Z.
  std::optional<v1::UpdateView> update_;
  std::vector<v1::Probe> probes_;
  std::vector<SamplePoint> pattern_;  ///< In the order in which frames add them.
  std::size_t drawn_ = 0;             ///< Samples of it.
  bool coarse_ = false;               ///< A coarse frame comes next.
  double sample_seconds_ = 1;         ///< What one sample of each pixel took last.
  bool xyz_sent_ = false;             ///< Of the complete frame of this revision.
  bool under_way_ = false;            ///< A frame is being drawn;
  double frame_seconds_ = 0;          ///< so much went into it.
  bool is_shown_ = false;             ///< `sum_` is a frame of this revision, that was sent;
  std::uint32_t shown_part_ = 1;      ///< whose pixels stand for so many on a side.
  std::vector<float> sum_, sample_;   ///< X Y Z of all pixels.
  std::vector<float> xyz_;            ///< Of a complete frame, where it was asked for.
  std::vector<std::uint8_t> rgb_;
};

}  // namespace metamer::worker
