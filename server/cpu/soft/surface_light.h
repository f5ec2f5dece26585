#pragma once

#include <array>
#include <memory>

#include "server/cpu/lanes.h"
#include "server/cpu/soft/pattern.h"
#include "server/cpu/soft/pointwise_light.h"
#include "server/scene/render_scene.h"

namespace metamer::cpu::soft {

/// A quad, disk or sphere that shines alike in all directions before it, as E[3.2-4] has luminance:
/// seen from the front it has the luminance L. It hides nothing, and from behind is not there.
class SurfaceLight {
 public:
  explicit SurfaceLight(const RenderLight& light);
  explicit SurfaceLight(std::shared_ptr<const PointwiseLight> pointwise);

  /// How it is seen from several points, for all samples there.
  struct View {
    Vectors at;
    Ints lanes;             ///< Those to which it shines.
    Ints near;              ///< Those whose samples are even in solid angle, by Ureña et al.
    Vectors axis;           ///< A sphere's: to its middle, unit.
    Floats distance, cone;  ///< A sphere's: to its middle; 1 − cosine of its half-angle.
    Floats x0, x1, y0, y1, z, b0, b1, k, angle;  ///< A quad's, as their paper names them.
    Ints own;  ///< Of a pointwise light: the primitive that the point lies in, or -1.
  };
  View view(const Vectors& at, Ints active) const;
  /// The same of points of which `own` lie in these primitives of the light's own surface.
  View view(const Vectors& at, Ints active, Ints own, Ints primitive) const;
  /// Lanes outside view.lanes have no weight.
  Samples sample(const View& view, const Points& point) const;

  /// Where rays meet its front, beyond 0; infinity: nowhere.
  Floats meet(const Vectors& origin, const Vectors& direction) const;

  float radiance() const { return radiance_; }  ///< L by the light's luminance.

 private:
  enum class Shape { quad, disk, sphere, pointwise };

  void view_sphere(View& view) const;
  void view_quad(View& view) const;
  Samples sample_sphere(const View& view, const Points& point) const;
  Samples sample_pointwise(const View& view, const Points& point) const;
  /// A point of the rectangle around it: what lies outside has no weight.
  Vectors even_point(const View& view, const Points& point) const;
  Vectors point_of(const Points& point) const;
  Ints covers(const Vectors& offset) const;

  Shape shape_;
  Eigen::Vector3d middle_, normal_;  ///< Of a sphere no normal.
  double radius_ = 0, area_ = 0;
  // The rectangle around a quad or disk: corner + a x + b y, of these lengths.
  Eigen::Vector3d corner_, x_, y_;
  double length_x_ = 0, length_y_ = 0;
  Eigen::Vector3d u_, v_;              ///< A quad's sides,
  Eigen::Vector3d along_u_, along_v_;  ///< and whose products with a place are a and b there.
  double least_near_ = 0;              ///< sr
  float radiance_ = 1;
  std::shared_ptr<const PointwiseLight> pointwise_;
};

}  // namespace metamer::cpu::soft
