#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/lights/registry.h"
#include "server/cpu/cutouts.h"
#include "server/cpu/embree_scene.h"
#include "server/cpu/media.h"
#include "server/cpu/normal_maps.h"
#include "server/cpu/packet.h"
#include "server/cpu/soft/soft_lights.h"
#include "server/cpu/texturing.h"
#include "server/models/packet.h"

namespace metamer::cpu {

/// Turns what a packet has hit into weights: looks towards each light, asks whether it is seen,
/// evaluates the models and gathers their lobes. Immutable, shared by threads.
class Shading {
 public:
  /// `footprint` as Texturing has it. So many samples of each light that is no place or direction.
  /// `media`: of a scene with surfaces through which lights shine; else null. The references must
  /// outlive it.
  Shading(const RenderScene& scene, const EmbreeScene& geometry, float footprint,
          std::uint32_t light_samples, const Media* media = nullptr);

  /// Turns the normals of what a packet has hit at packet.hit, where the scene has maps of them.
  void turn_normals(const Packet& packet, Hits& hits) const {
    if (normal_maps_.is_needed()) normal_maps_.turn(packet, hits);
  }
  void shade(const Packet& packet, const Hits& hits, Workspace& workspace) const;
  /// The rays to where the diffuse light of the active lanes comes from that is no light's own: the
  /// `way`-th of `ways` that share it. They are chosen by the cosine of their angle to the normal,
  /// and weighed by the model; the one spectrum of a texture by its share. Lanes that scatter
  /// nothing are not active there.
  Packet diffused(const Packet& packet, const Hits& hits, std::uint32_t way, std::uint32_t ways,
                  Workspace& workspace) const;
  const soft::SoftLights& soft() const { return soft_; }

 private:
  using Lobes = models::Lobes<Floats>;
  using Angles = models::Angles<Floats>;

  struct Light {
    bool is_place;
    lights::Light light;
    lights::Values<Floats> values;
    Floats solid_angle;
  };
  /// Where the lanes of a packet are gathered.
  struct Places {
    std::array<std::uint32_t, lane_count> surface{};  ///< Of the pixel's gather.
    /// By group: all of its active lanes in the same place, of which one is `first`.
    std::array<bool, group_count> together{};
    std::array<unsigned, group_count> first{};
    /// What of the diffuse light stays there; the rest is in Workspace::texture_shares.
    Floats own_diffuse = metamer::broadcast(1);
  };
  /// One light's part of a packet.
  struct Step {
    const Packet& packet;
    const Hits& hits;
    const Places& places;
    std::uint32_t light;
    Workspace& workspace;
  };

  void shade_soft(const Packet& packet, const Hits& hits, const Places& places, Ints ambient,
                  Workspace& workspace) const;
  void shade_by_sky(const Packet& packet, const Hits& hits, const Places& places, Ints ambient,
                    Workspace& workspace) const;
  std::uint32_t light_samples(const Packet& packet) const;
  Ints reached(const Hits& hits, const Vectors& direction) const;
  Ints lit_by(const Step& step, const Vectors& direction, Floats reach, Ints lanes) const;
  Places find_places(const Packet& packet, const Hits& hits, Workspace& workspace) const;
  Ints ambient_lanes(const Hits& hits, Ints active) const;
  void reflect(const Step& step, Ints lit, Ints wanted, const Vectors& to_light,
               Floats weight) const;
  void shade_through(const Step& step, Ints lanes, Ints ambient, const Vectors& to_light,
                     Floats reach, Floats weight) const;
  Lobes evaluate(const RenderMaterial& material, const Angles& angles, Workspace& workspace) const;
  Lobes evaluate_hits(const Step& step, Ints lanes, Ints lit, const Vectors& to_light,
                      Floats weight) const;
  Lobes evaluate_each(const Hits& hits, Ints lanes, const Angles& angles,
                      Workspace& workspace) const;
  Floats scattered(const Packet& packet, const Hits& hits, const Vectors& direction,
                   Workspace& workspace) const;
  void interpolate(const Step& step, Ints lanes, Lobes& lobes) const;
  void gather(const Step& step, Lobes lobes, Ints lanes) const;
  static void scale(Lobes& lobes, Floats factor) {
    lobes.diffuse *= factor;
    lobes.specular *= factor;
    lobes.white *= factor;
    lobes.fresnel *= factor;
  }
  static void gather_fresnel(const Step& step, int lane, float cosine, float weight);
  void gather_factors(const Step& step, const Lobes& lobes) const;
  void gather_rough(const Step& step, const Lobes& lobes) const;

  const RenderScene& scene_;
  const EmbreeScene& geometry_;
  const Media* media_;
  std::vector<Light> lights_;
  Texturing texturing_;
  NormalMaps normal_maps_;
  soft::SoftLights soft_;
  NeededAngles needed_;
  bool has_ambient_ = false, has_factors_ = false, has_rough_ = false;
  bool own_side_;  ///< A surface does not always shade itself from what is below it.
};

}  // namespace metamer::cpu
