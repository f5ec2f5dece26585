#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "server/cpu/embree_scene.h"
#include "server/cpu/packet.h"
#include "server/cpu/soft/sky.h"
#include "server/cpu/soft/surface_light.h"

namespace metamer::cpu::soft {

/// The lights of a scene that are no place or direction: those with a surface, and the environment.
/// Immutable, shared by threads.
class SoftLights {
 public:
  /// So many samples of each, of a sample of a pixel. The scene must outlive them.
  SoftLights(const RenderScene& scene, const EmbreeScene& geometry, std::uint32_t samples);

  bool empty() const { return surfaces_.empty() && !sky_; }

  struct Surface {
    std::uint32_t light;  ///< Index into RenderScene::lights.
    bool visible;
    SurfaceLight shape;
    int object = -1;        ///< Of an object that shines; -1: it hides nothing, and is none.
    bool mirrored = false;  ///< That object shines to what Embree has as its back.
    SurfaceLight::View view(const Vectors& at, Ints active, const Hits& hits) const {
      if (object < 0) return shape.view(at, active);
      return shape.view(at, active, hits.object == object, hits.primitive);
    }
    /// For rays from `lifted`, a little off the view's points: an object's own surface is met where
    /// the sample lies, however obliquely.
    Samples sample(const SurfaceLight::View& view, const Points& point,
                   const Vectors& lifted) const;
  };
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  const std::optional<Sky>& sky() const { return sky_; }
  std::uint32_t samples() const { return samples_; }

  /// What rays meet that shines.
  struct Seen {
    Ints surface;     ///< Index into surfaces(); below 0: none.
    Floats distance;  ///< Along the ray, of a surface.
    Ints sky;         ///< Mask: the environment.
  };
  /// A surface before what was hit ends the way, and takes it out of `hits`.
  Seen find(const Packet& packet, Hits& hits) const;
  /// Gives that light, over the chains of the packet.
  void add(const Packet& packet, const Seen& seen, Workspace& workspace) const;
  /// Gives the light of objects that these lanes have hit in front. A surface that scatters has
  /// looked at it already.
  void add_objects(const Packet& packet, const Hits& hits, Ints lanes, Workspace& workspace) const;

  /// What each light sends to a surface that the first lane has met, by its cosine; 0 for those
  /// that are a place or direction.
  std::vector<double> on_surface(const EmbreeScene& geometry, const Vectors& hit,
                                 const Vectors& lifted, const Vectors& normal,
                                 std::size_t lights) const;

 private:
  std::vector<Surface> surfaces_;
  std::vector<int> of_object_;  ///< Index into surfaces_, or -1; empty: no object shines.
  std::optional<Sky> sky_;
  std::uint32_t samples_;
};

/// The number of a lane's point for a light, among all that its pixel looks at.
inline Pattern pattern_of(const Packet& packet, unsigned lane, std::uint32_t samples,
                          std::uint32_t j, std::uint32_t light) {
  return {packet.sample[lane] * samples + j, hashed(packet.seed[lane], light)};
}

}  // namespace metamer::cpu::soft
