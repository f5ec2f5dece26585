#pragma once

#include <memory>

#include "server/cpu/probe.h"
#include "server/render/renderer.h"

namespace metamer::gl {

/// What pixels receive is traced on the CPU, whose pictures the GPU's agree with; what a picture
/// costs is seen by drawing a small one.
class DrawingProbe : public Probe {
 public:
  /// Both must outlive it. Changes what the renderer draws by.
  DrawingProbe(Renderer& renderer, const RenderScene& scene, unsigned threads)
      : renderer_(renderer), tracing_(std::make_shared<cpu::Geometry>(scene, threads)) {}

  bool prepare(const std::atomic<bool>& cancelled) override { return tracing_.prepare(cancelled); }
  TracedPixels trace(const v1::Plan& plan, PixelRun run, const std::atomic<bool>& stopped,
                     std::atomic<std::uint64_t>& work) const override {
    return tracing_.trace(plan, run, stopped, work);
  }
  std::optional<SeenPoint> look(const v1::Plan& plan, std::uint32_t x,
                                std::uint32_t y) const override {
    return tracing_.look(plan, x, y);
  }
  double picture_seconds(const v1::Plan& plan, const Method& method, double pixel_seconds,
                         const std::atomic<bool>& stopped,
                         std::atomic<std::uint64_t>& work) override;

 private:
  Renderer& renderer_;
  cpu::TracingProbe tracing_;
  std::uint32_t side_ = 0;  ///< The longer one of the small picture, in pixels; 0: not yet chosen.
};

}  // namespace metamer::gl
