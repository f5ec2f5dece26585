#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/worker.pb.h"
#include "server/film/develop.h"
#include "server/film/sample_pattern.h"
#include "server/methods/method.h"
#include "server/worker/job.h"
#include "server/worker/view_scene.h"

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
  void add_credit() { ++credits_; }

  /// Its scene is being imported, on a thread of its own: until then it has no work.
  bool is_importing() const { return scene_.is_importing() && !scene_.is_imported(); }
  /// The import is of no use to anybody.
  void cancel_import() { scene_.cancel_import(); }
  bool has_work() const {
    return scene_.is_importing() ? scene_.is_imported() : update_ || has_frame();
  }
  /// Takes what was imported, or carries out the update; either sends Updated, or Refused and the
  /// view stays as it was. Then draws at the next frame for about a frame's time, and sends it in
  /// bands once it is whole. False: the view is lost, and Closed was sent.
  bool turn();

 private:
  using Clock = std::chrono::steady_clock;

  bool has_frame() const { return credits_ > 0 && drawn_ < pattern_.size(); }
  bool change(const v1::UpdateView& message);
  bool adopt();
  bool prepare();
  void begin_anew();
  bool draw();
  void send_frame(std::uint32_t width, std::uint32_t height);
  void send_updated(bool planned);
  bool refuse(std::uint64_t revision, const Problems& problems);
  void send_closed(v1::Failed::Kind kind, const std::string& reason, const Problems& problems = {});
  v1::WorkerEnvelope event() const;

  std::uint64_t id_;
  const WorkerOptions& options_;
  Link& link_;
  Work& work_;

  ViewScene scene_;
  v1::Plan plan_;
  std::unique_ptr<Method> method_;  ///< Null: not yet open.
  std::optional<Developer> developer_;

  std::uint64_t revision_ = 0;
  std::uint64_t asked_revision_ = 0;  ///< Of the change that is being carried out,
  Clock::time_point begun_;           ///< since then.
  unsigned credits_ = 0;
  std::optional<v1::UpdateView> update_;
  std::vector<SamplePoint> pattern_;  ///< In the order in which frames add them.
  std::size_t drawn_ = 0;             ///< Samples of it.
  bool coarse_ = false;               ///< A coarse frame comes next.
  double sample_seconds_ = 1;         ///< What one sample of each pixel took last.
  bool under_way_ = false;            ///< A frame is being drawn;
  double frame_seconds_ = 0;          ///< so much went into it.
  std::vector<float> sum_, sample_;   ///< X Y Z of all pixels.
  std::vector<std::uint8_t> rgb_;
};

}  // namespace metamer::worker
