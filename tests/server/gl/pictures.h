#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/color/error_statistics.h"
#include "metamer/v1/scene.pb.h"
#include "server/cpu/embree_scene.h"
#include "server/gl/context.h"
#include "server/gl/programs.h"
#include "server/methods/method.h"
#include "server/scene/render_scene.h"

namespace metamer::gl {

/// A scene of deploy/ with its files.
struct SceneOnDisk {
  v1::Scene message;
  std::string folder;
};
SceneOnDisk read_deployed(const std::string& path);
/// In camera space.
RenderScene compile(const SceneOnDisk& scene);

/// One scene, drawn by both backends without mirrors.
class Pictures {
 public:
  explicit Pictures(const SceneOnDisk& scene);

  using Xyz = std::vector<float>;  ///< X Y Z of each pixel.
  Xyz by_cpu(const v1::Method& method) const;
  /// Needs a current context.
  Result<Xyz> by_gl(const v1::Method& method, ProgramCache& cache) const;

  /// The pixels whose samples, and those of the eight around them, all see one object and the same
  /// lights: on no silhouette, on no shadow's edge, and on no edge between facets of CONSTANT
  /// shading.
  const std::vector<bool>& smooth() const { return smooth_; }
  std::uint32_t width() const { return settings_.width(); }
  std::uint32_t height() const { return settings_.height(); }
  /// ΔE00 of each pixel, the first picture's white that of a white that faces the dominant light.
  std::vector<double> differences(const Xyz& a, const Xyz& b) const;
  /// The object that the middle of each pixel shows; -1: none.
  const std::vector<int>& objects() const { return objects_; }
  const RenderScene& scene() const { return scene_; }

 private:
  v1::Plan plan(const v1::Method& method) const;
  void find_edges();

  RenderScene scene_;
  v1::Settings settings_;
  std::optional<cpu::EmbreeScene> geometry_;
  std::vector<bool> smooth_;
  std::vector<int> objects_;
};

}  // namespace metamer::gl
