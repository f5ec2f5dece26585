#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>

#include "common/problem.h"

namespace metamer {

/// Calls `work(begin, end)` for pieces of 0 to `count`, on all threads of the calling arena.
template <typename Work>
void for_ranges(std::size_t count, const Work& work) {
  constexpr std::size_t grain =
      16384;  // About 100 µs of a mesh's work: small meshes use one thread.
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const auto& range) { work(range.begin(), range.end()); });
}

/// The problem that stands first in a file, whichever thread finds one first.
class FirstProblem {
 public:
  void keep(std::size_t place, Problem problem) {
    const std::lock_guard lock(mutex_);
    if (problem_ && place_ <= place) return;
    place_ = place;
    problem_ = std::move(problem);
  }
  const std::optional<Problem>& get() const { return problem_; }

 private:
  std::mutex mutex_;
  std::size_t place_ = 0;
  std::optional<Problem> problem_;
};

}  // namespace metamer
