#pragma once

#include "server/cpu/media.h"
#include "server/cpu/packet.h"
#include "server/cpu/shading.h"

namespace metamer::cpu {

/// Diffuse reflections between surfaces.
struct Diffusion {
  std::uint32_t bounces = 0;  ///< That a path may take.
  std::uint32_t samples = 1;  ///< Ways on from the first; from others one.
};

/// Follows rays that split at clear surfaces, at what is not all there, and where light is diffuse:
/// a tree of paths, by a
/// stack of packets. What is
/// carried is radiance by n², which refraction leaves as it is: in a picture that is taken within a
/// medium it is what an eye in air would see if nothing were reflected at the way out. Surfaces
/// within a medium reflect as they do in air; a clear surface's own model sees light from outside
/// alone. Immutable, shared by threads.
class RayTree {
 public:
  /// The references must outlive it.
  RayTree(const RenderScene& scene, const EmbreeScene& geometry, const Media& media,
          const Shading& shading, unsigned depth, float cutoff, const Diffusion& diffusion);

  /// `camera` rays, whose light goes into `workspace.gathers`.
  void trace(const Packet& camera, Workspace& workspace) const;

 private:
  /// Some paths of a tree, a lane each.
  struct Branch {
    Packet packet;
    MediaStacks inside{};
    Vectors from{};                             ///< Where it met the surface before, or the eye.
    Floats importance = metamer::broadcast(1);  ///< The most that the path counts, about.
    Ints bundle = Ints{} - 1;                   ///< Of wavelengths; -1: all of them.
    unsigned depth = 0;                         ///< Reflections and refractions so far.
    unsigned surfaces = 0;                      ///< With those that changed nothing.
    unsigned bounces = 0;                       ///< Diffuse reflections so far.
    float share = 1;                            ///< Of the ways that the camera ray has gone.
  };
  /// Where the paths of a branch go on.
  struct Children {
    Branch reflected, transmitted, straight;
    Ints dispersed{};  ///< Lanes that split into bundles first.
  };

  enum class Parts { reflected, transmitted, both };

  void follow(Branch& branch, std::vector<Branch>& stack, Workspace& workspace) const;
  void see(const Branch& branch, Hits& hits, Workspace& workspace) const;
  void absorb(Branch& branch, Workspace& workspace) const;
  Ints shaded_lanes(const Branch& branch, const Hits& hits, const Media::Crossing& crossing,
                    Ints clear) const;
  void mirror_layers(const Branch& branch, const Hits& hits, const Packet& shaded, Ints layered,
                     std::vector<Branch>& stack, Workspace& workspace) const;
  void split(const Branch& branch, const Hits& hits, const Media::Crossing& crossing,
             Children& children, Workspace& workspace) const;
  void disperse(const Branch& branch, const Hits& hits, const Media::Crossing& crossing, Ints lanes,
                std::vector<Branch>& stack, Workspace& workspace) const;
  void refract_at(const Media::Interface& interface, const Branch& branch, const Hits& hits,
                  const Media::Crossing& crossing, unsigned lane, Children& children,
                  Workspace& workspace, Parts parts) const;
  void diffuse(const Branch& branch, const Packet& shaded, const Hits& hits,
               std::vector<Branch>& stack, Workspace& workspace) const;
  void mirror(const Branch& branch, const Hits& hits, unsigned lane, Children& children,
              Workspace& workspace) const;
  static void end(const Branch& branch, unsigned lane, double& sum);
  Children children_of(const Branch& branch) const;
  void push_all(Children& children, std::vector<Branch>& stack, Workspace& workspace) const;
  void push(Branch& child, std::vector<Branch>& stack, Workspace& workspace) const;
  static bool goes_on(Branch& child, unsigned lane);

  const RenderScene& scene_;
  const EmbreeScene& geometry_;
  const Media& media_;
  const Shading& shading_;
  unsigned depth_;
  float cutoff_;
  Diffusion diffusion_;
};

}  // namespace metamer::cpu
