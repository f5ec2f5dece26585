#pragma once

#include <atomic>
#include <vector>

#include "server/cpu/probe.h"
#include "server/render/choose.h"
#include "tests/promises/varied_scenes.h"

namespace metamer::promises {

/// A scene of which the truth is known: every pixel by plain sums (PlainTruth).
class MeasuredScene {
 public:
  explicit MeasuredScene(const VariedScene& scene);

  PilotScene pilot() { return {scene_, probe_, settings_, capabilities_, never_, work_}; }

  /// The whole picture by a method.
  struct Rendered {
    double seconds;  ///< Of its tables and its pixels, on one thread.
    v1::ColorError error;
  };
  Rendered render(const v1::Method& method);

 private:
  Capabilities capabilities_{.threads = 1};
  const std::atomic<bool> never_ = false;
  std::atomic<std::uint64_t> work_ = 0;
  RenderScene scene_;
  v1::Settings settings_;
  std::shared_ptr<cpu::Geometry> geometry_;
  cpu::TracingProbe probe_;
  Xyz white_;
  std::vector<Lab> truth_;
};

v1::Goal tolerance(double value);

}  // namespace metamer::promises
