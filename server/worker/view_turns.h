#pragma once

#include <chrono>
#include <functional>

namespace metamer::worker {

/// How long a job or a view works on while others wait: about a frame's time.
inline constexpr std::chrono::milliseconds turn_time{20};

/// The views, as the job knows them: they want the processors or the GPU between two parts of its
/// picture.
class ViewTurns {
 public:
  virtual ~ViewTurns() = default;
  /// Whether a view has something to do; from any thread.
  virtual bool waiting() const = 0;
  /// Gives each view that has one turn, in the lane's thread.
  virtual void serve() = 0;
  /// Serves the views while `work` is done on a thread of its own, and returns when it is.
  virtual void serve_while(const std::function<void()>& work) = 0;
};

}  // namespace metamer::worker
