#pragma once

#include <memory>
#include <optional>

#include "metamer/v1/plan.pb.h"
#include "server/film/film.h"
#include "server/gl/camera.h"
#include "server/gl/geometry.h"
#include "server/gl/multi_pass.h"
#include "server/gl/pass_clock.h"
#include "server/gl/programs.h"
#include "server/gl/target.h"
#include "server/methods/method.h"
#include "server/render/renderer.h"

namespace metamer::gl {

/// Renders a scene by rasteriser and compute shaders: each sample of a pixel is a picture of its
/// own, whose rasteriser leaves the names of what is seen; then, for each light, a compute shader
/// finds the point again, asks whether the light is seen, evaluates the model and gathers its
/// weights; and a method's tables make X Y Z of them. No mirrors. Needs a current Context.
class Passes {
 public:
  /// `scene` in camera space; it and `geometry` must outlive the renderer. Its camera may be
  /// another one for each picture. Errors: what this device does not hold or compile.
  static Result<Passes> create(const RenderScene& scene, const Geometry& geometry,
                               const v1::Plan& plan, const Method& method, ProgramCache& cache,
                               bool timers);

  /// Of a region: what its pixels gather fits any device, and its tiles are told before long.
  static constexpr std::uint32_t max_side = 256;

  /// Begins a region of the picture that fills a film of this size, from where the scene's camera
  /// is now. Errors: a region that this device does not hold.
  Result<void> begin(const Rect& region, const Film& film);
  /// Others have used the context since the last call.
  void bind() const;
  /// Adds one sample of each of the region's pixels. Looks at `cancelled` before each light and
  /// pass, and then leaves the rest out; counts each as work, since software takes long for one.
  /// Errors: the context is gone.
  Result<void> add(SamplePoint place, const Control& control);
  /// Writes X Y Z of the region's pixels into the film, the mean of so many samples; not once
  /// `cancelled`.
  Result<void> finish(const Film& film, std::size_t samples, const Control& control);

  const PassClock& clock() const { return *clock_; }

 private:
  Passes(const RenderScene& scene, const Geometry& geometry) : scene_(scene), geometry_(geometry) {}
  Result<void> upload(const DirectTables& tables);
  Result<void> resize(const Rect& region);
  void for_each_light(const Program& program, const Rect& region, const Control& control) const;
  void evaluate_places();
  void read_back(const Rect& region, const Film& film, std::size_t samples) const;

  const RenderScene& scene_;
  const Geometry& geometry_;
  std::shared_ptr<const Programs> programs_;
  Buffer materials_, values_, sensors_, lights_, places_, weights_, colors_;
  std::uint32_t value_size_ = 0, row_stride_ = 0, light_stride_ = 0, sensor_stride_ = 0;
  std::uint32_t places_of_triangle_ = 0;  ///< 0: models are evaluated at samples.
  std::optional<Eigen::Vector3d> places_seen_from_;
  std::optional<RegionView> view_;  ///< Of the region under way.
  Target target_;
  std::unique_ptr<MultiPass> multi_pass_;  ///< Where the plan asks for it.
  std::unique_ptr<PassClock> clock_;
};

}  // namespace metamer::gl
