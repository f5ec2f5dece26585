#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "server/render/renderer.h"

namespace metamer::worker {

/// A backend that draws nothing much, and does as it is told. A pixel gets (x, y, samples) as X Y
/// Z.
class FakeBackend : public Backend {
 public:
  v1::Backend id() const override { return v1::CPU; }
  std::string name() const override { return "fake"; }
  Features features() const override { return features_; }
  void describe(v1::Capabilities&) const override {}
  Result<void> enter() override { return {}; }
  bool is_sound() const override { return true; }
  std::unique_ptr<Renderer> make_renderer(const RenderScene& scene,
                                          const std::string& key) const override;

  // What its renderers do.
  std::string change_problem, draw_problem;  ///< Empty: none.
  std::function<void()> before_tile = [] {};
  Features features_ = Features::all();
  std::vector<Gather> traced_;  ///< By its probes.

  // What its renderers were asked for.
  struct Seen {
    std::atomic<int> renderers = 0, prepared = 0, changes = 0, pictures = 0, draws = 0;
    std::string key;                   ///< Of the last renderer.
    std::vector<SamplePoint> samples;  ///< Of the last picture.
  };
  mutable Seen seen;
};

}  // namespace metamer::worker
