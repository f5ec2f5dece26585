#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/problem.h"
#include "common/scene/features.h"
#include "metamer/v1/factors.pb.h"
#include "metamer/v1/plan.pb.h"
#include "metamer/v1/session.pb.h"
#include "server/film/film.h"
#include "server/film/sample_pattern.h"
#include "server/methods/method.h"
#include "server/render/probe.h"
#include "server/render/ray_counts.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// A tile that is whole on the film.
struct DrawnTile {
  Rect rect;
  std::uint64_t rays;              ///< That were traced for it, as far as they are counted.
  const v1::TileFactors* factors;  ///< What its pixels received; null where nobody asked.
};

/// What is drawn, from where the scene's camera is.
struct Picture {
  Film film;                         ///< Of any size; pixels are square.
  std::vector<SamplePoint> samples;  ///< Of each pixel; at least one.
  /// The parts in which it is wanted, in this order: inside the film, corners on multiples of 8.
  /// Empty: the whole film, in parts that the renderer chooses and does not tell.
  std::vector<Rect> tiles;
  std::function<void(const DrawnTile&)> tile_done;  ///< From any thread; several at a time.
  bool keep_factors = false;                        ///< Only of renderers that can.
};

/// When to leave off, and who is told that something goes on. Asked from any thread.
struct Control {
  const std::atomic<bool>& cancelled;  ///< The picture is of no more use.
  std::function<bool()> is_over;       ///< Others have their turn.
  std::atomic<std::uint64_t>& work;    ///< Counts samples of pixels, or pixels.
};

/// Draws one scene in camera space, which must outlive it. See README.md for its threads.
class Renderer {
 public:
  virtual ~Renderer() = default;

  /// Builds what depends on objects alone and needs no device, the first time; from any thread,
  /// with the threads of its arena. False: cancelled.
  virtual bool prepare(const std::atomic<bool>& cancelled) = 0;

  /// Lights, materials, plan or method are others, or the first ones; plan and method must outlive
  /// the next change. A picture that was begun ends. Errors: what the device does not hold or
  /// compile; an empty message where `cancelled` became true.
  virtual Result<void> change(const v1::Plan& plan, const Method& method,
                              const std::atomic<bool>& cancelled) = 0;

  /// Begins a picture, after a change(); the one before ends.
  virtual void begin(Picture picture) = 0;

  /// Draws on, part by part. Returns between two parts once `is_over`, and goes on there the next
  /// time; leaves a part as it is when `cancelled`. True: the picture is whole. Errors: the device
  /// is lost, or does not hold a part.
  virtual Result<bool> draw(const Control& control) = 0;

  /// Adds what the building in change() took since the last time, and sets what drawing went into.
  virtual void report(v1::Timing& timing) = 0;

  /// What of its building an earlier job had left: "programs", "geometry". After a change().
  virtual std::vector<std::string> warm() const { return {}; }
  /// Those of the picture's whole tiles so far, by the thread that draws; none: they are not
  /// counted.
  virtual RayCounts rays() const { return {}; }

  /// This scene for the choice of a method; belongs to the lane's thread, and ends before this.
  virtual std::unique_ptr<Probe> make_probe() = 0;
};

/// A way of drawing, as a worker's process has it.
class Backend {
 public:
  virtual ~Backend() = default;

  virtual v1::Backend id() const = 0;
  virtual std::string name() const = 0;  ///< "cpu", as on the wire.
  virtual Features features() const = 0;
  /// Adds what clients learn of its device.
  virtual void describe(v1::Capabilities& to) const = 0;

  /// The calling thread is the lane from here on. Errors: the device does not let it.
  virtual Result<void> enter() = 0;
  /// False: the device is lost, for this process.
  virtual bool is_sound() const = 0;

  /// `key` names all that the scene's geometry depends on. From any thread.
  virtual std::unique_ptr<Renderer> make_renderer(const RenderScene& scene,
                                                  const std::string& key) const = 0;
};

}  // namespace metamer
