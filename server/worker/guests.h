#pragma once

namespace metamer {

/// Those who want the processors or the GPU between two parts of a job's picture.
class Guests {
 public:
  virtual ~Guests() = default;
  virtual bool waiting() const = 0;  ///< From any thread.
  /// Serves each of them once, in the lane's thread.
  virtual void serve() = 0;
};

}  // namespace metamer
