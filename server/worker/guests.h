#pragma once

#include <chrono>
#include <functional>

namespace metamer {

/// How long a job or a view works on while others wait: about a frame's time.
inline constexpr std::chrono::milliseconds turn_time{20};

/// Those who want the processors or the GPU between two parts of a job's picture.
class Guests {
 public:
  virtual ~Guests() = default;
  virtual bool waiting() const = 0;  ///< From any thread.
  /// Serves each of them once, in the lane's thread.
  virtual void serve() = 0;
  /// Serves them while `work` is done on a thread of its own, and returns when it is.
  virtual void serve_while(const std::function<void()>& work) = 0;
};

}  // namespace metamer
