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
#include "server/models/lanes.h"

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
  using Lobes = models::Lobes<Float8>;
  using Angles = models::Angles<Float8>;

  struct Light {
    bool is_place;
    lights::Light light;
    lights::Values<Float8> values;
    Float8 solid_angle;
  };
  /// Where the lanes of a packet are gathered.
  struct Places {
    std::array<std::uint32_t, 8> surface{};  ///< Of the pixel's gather.
    bool together = true;                    ///< All active lanes in the same place.
    unsigned first = 0;                      ///< An active lane.
    /// What of the diffuse light stays there; the rest is in Workspace::texture_shares.
    Float8 own_diffuse = metamer::broadcast(1);
  };
  /// One light's part of a packet.
  struct Step {
    const Packet& packet;
    const Hits& hits;
    const Places& places;
    std::uint32_t light;
    Workspace& workspace;
  };

  void shade_soft(const Packet& packet, const Hits& hits, const Places& places, Int8 ambient,
                  Workspace& workspace) const;
  void shade_by_sky(const Packet& packet, const Hits& hits, const Places& places, Int8 ambient,
                    Workspace& workspace) const;
  std::uint32_t light_samples(const Packet& packet) const;
  Int8 reached(const Hits& hits, const Vec8& direction) const;
  Int8 lit_by(const Step& step, const Vec8& direction, Float8 reach, Int8 lanes) const;
  Places find_places(const Packet& packet, const Hits& hits, Workspace& workspace) const;
  Int8 ambient_lanes(const Hits& hits, Int8 active) const;
  void reflect(const Step& step, Int8 lit, Int8 wanted, const Vec8& to_light, Float8 weight) const;
  void shade_through(const Step& step, Int8 lanes, Int8 ambient, const Vec8& to_light, Float8 reach,
                     Float8 weight) const;
  Lobes evaluate(const RenderMaterial& material, const Angles& angles, Workspace& workspace) const;
  Lobes evaluate_hits(const Step& step, Int8 lanes, Int8 lit, const Vec8& to_light,
                      Float8 weight) const;
  Lobes evaluate_each(const Hits& hits, Int8 lanes, const Angles& angles,
                      Workspace& workspace) const;
  Float8 scattered(const Packet& packet, const Hits& hits, const Vec8& direction,
                   Workspace& workspace) const;
  void interpolate(const Step& step, Int8 lanes, Lobes& lobes) const;
  void gather(const Step& step, Lobes lobes, Int8 lanes) const;
  static void scale(Lobes& lobes, Float8 factor);
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
