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
#include "server/worker/assets.h"
#include "server/worker/job.h"
#include "server/worker/view_picture.h"

namespace metamer {

/// A scene that a client looks at and changes. Keeps everything that a change leaves as it is:
/// after a camera only frames are drawn, after a light or a material their tables are made anew,
/// and geometry only where objects would look different. Belongs to the lane's thread.
class View {
 public:
  using Problems = std::vector<Problem>;

  /// While `hurried` no frame is drawn to its end: others can't wait for it.
  View(std::uint64_t id, const WorkerOptions& options, Link& link, Work& work,
       const std::atomic<bool>& hurried);
  ~View();

  /// Sends Updated, or Closed and why: then false.
  bool open(const v1::OpenView& message);
  /// Sends Updated; or Refused, and the view stays as it was. False: it was lost on the way, and
  /// Closed was sent.
  bool update(const v1::UpdateView& message);

  void add_credit() { ++credits_; }
  /// A frame was asked for, and there is one to draw.
  bool has_frame() const { return credits_ > 0 && drawn_ < pattern_.size(); }
  /// Draws the next frame and sends it in bands, unless it is hurried. False: it can't be drawn,
  /// and Closed was sent.
  bool draw();

 private:
  using Clock = std::chrono::steady_clock;

  AssetNames opened(const AssetNames& names) const;
  tl::expected<void, Problems> compile(const v1::Scene& scene, const AssetNames& names);
  tl::expected<void, Problems> recompile(const v1::Scene& scene, const AssetNames& names);
  bool prepare(Clock::time_point start);
  void begin_anew();
  Result<bool> draw_sample(std::uint32_t width, std::uint32_t height, std::size_t index);
  void send_frame(std::uint32_t width, std::uint32_t height, v1::Frame frame);
  void send_updated(Clock::time_point start, bool planned);
  bool refuse(std::uint64_t revision, const Problems& problems);
  void send_closed(v1::Failed::Kind kind, const std::string& reason, const Problems& problems = {});
  v1::WorkerEnvelope event() const;

  std::uint64_t id_;
  const WorkerOptions& options_;
  Link& link_;
  Work& work_;
  const std::atomic<bool>& hurried_;

  v1::Scene message_;    ///< As it now is, its settings complete.
  AssetNames names_;     ///< Those of the opening first.
  int opened_with_ = 0;  ///< So many.
  CameraSpace space_;
  std::string objects_key_;
  std::unique_ptr<RenderScene> scene_;
  v1::Plan plan_;
  std::unique_ptr<Method> method_;
  std::unique_ptr<ViewPicture> picture_;
  std::optional<Developer> developer_;

  std::uint64_t revision_ = 0;
  unsigned credits_ = 0;
  std::vector<SamplePoint> pattern_;  ///< In the order in which frames add them.
  std::size_t drawn_ = 0;             ///< Samples of it.
  bool coarse_ = false;               ///< A coarse frame comes first.
  double sample_seconds_ = 1;         ///< What one sample of each pixel took last.
  std::vector<float> sum_, sample_;   ///< X Y Z of all pixels.
  std::vector<std::uint8_t> rgb_;
};

}  // namespace metamer
