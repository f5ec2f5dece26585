#pragma once

#include <memory>
#include <optional>

#include "server/cpu/embree_scene.h"
#include "server/render/probe.h"

namespace metamer::cpu {

/// A scene's geometry, built when it is first asked for. Not moved: others refer to it.
class Geometry {
 public:
  /// `scene` must outlive it; so many threads build it.
  Geometry(const RenderScene& scene, unsigned threads) : scene_(scene), threads_(threads) {}

  /// False: cancelled.
  bool prepare(const std::atomic<bool>& cancelled);
  const RenderScene& scene() const { return scene_; }
  /// Once it is prepared.
  const EmbreeScene& embree() const { return *embree_; }

 private:
  const RenderScene& scene_;
  unsigned threads_;
  std::optional<EmbreeScene> embree_;
};

/// Traces pixels for the choice of a method. What the tracer costs is what a picture costs.
class TracingProbe : public Probe {
 public:
  explicit TracingProbe(std::shared_ptr<Geometry> geometry) : geometry_(std::move(geometry)) {}

  bool prepare(const std::atomic<bool>& cancelled) override {
    return geometry_->prepare(cancelled);
  }
  TracedPixels trace(const v1::Plan& plan, PixelRun run, const std::atomic<bool>& stopped,
                     std::atomic<std::uint64_t>& work) const override;
  std::optional<SeenPoint> look(const v1::Plan& plan, std::uint32_t x,
                                std::uint32_t y) const override;
  double picture_seconds(const v1::Plan& plan, const Method& method, double pixel_seconds,
                         const std::atomic<bool>& stopped,
                         std::atomic<std::uint64_t>& work) override;

 private:
  std::shared_ptr<Geometry> geometry_;
};

}  // namespace metamer::cpu
