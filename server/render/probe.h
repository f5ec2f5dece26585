#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "metamer/v1/plan.pb.h"
#include "server/methods/method.h"
#include "server/transport/gather.h"

namespace metamer {

/// A run of the places of a sequence. It fills the picture evenly (M. Roberts' R2, the plastic
/// number's powers): runs that do not overlap are of different pixels, but for chance. Or its
/// places are drawn at random, each by itself: by SplitMix64, so the same ones each time.
struct PixelRun {
  std::uint32_t first, count;
  bool random = false;
  /// Another one: other points of lights, other ways between surfaces; 0 has the picture's own.
  std::uint32_t seed = 0;
};

/// Pixels before any spectrum: sums over the samples of each.
struct TracedPixels {
  std::vector<Gather> gathers;
  double seconds = 0;  ///< A pixel, on one thread of the CPU that does nothing else.
  double rays = 0;     ///< A pixel.
};

/// What the eye meets first in the middle of a pixel; in camera space.
struct SeenPoint {
  std::uint32_t object;           ///< Index into RenderScene::objects.
  Eigen::Vector3d place, normal;  ///< The normal is unit and towards the eye.
  Gather eye;                     ///< What comes from there to the eye, by mirrors too.
  std::vector<double> light;      ///< Of each light, what falls there by its cosine; 0: not seen.
};

/// A scene by one backend, for the choice of a method: what some of its pixels receive, and what a
/// picture would cost. Also for who points at a pixel. Belongs to one thread.
class Probe {
 public:
  virtual ~Probe() = default;

  /// Builds what trace() and look() need, the first time; as Renderer::prepare.
  virtual bool prepare(const std::atomic<bool>& cancelled) = 0;

  /// The pixels of the run, by the CPU's tracer; of an even run also those that share packets with
  /// them, and it has as many fewer places. Stops early, with what it has, once
  /// `stopped`; `work` counts pixels.
  virtual TracedPixels trace(const v1::Plan& plan, PixelRun run, const std::atomic<bool>& stopped,
                             std::atomic<std::uint64_t>& work) const = 0;

  /// In a pixel of the plan's picture, by the CPU's tracer; nothing: there is nothing to be seen.
  virtual std::optional<SeenPoint> look(const v1::Plan& plan, std::uint32_t x,
                                        std::uint32_t y) const = 0;

  /// Seconds that the plan's picture takes by this method, where one thread of the CPU makes a
  /// pixel by it in `pixel_seconds`. Infinite where it can't be drawn.
  virtual double picture_seconds(const v1::Plan& plan, const Method& method, double pixel_seconds,
                                 const std::atomic<bool>& stopped,
                                 std::atomic<std::uint64_t>& work) = 0;
};

}  // namespace metamer
