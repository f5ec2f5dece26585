#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "server/cpu/cutouts.h"
#include "server/cpu/embree_scene.h"
#include "server/cpu/packet.h"
#include "server/scene/render_scene.h"

namespace metamer::cpu {

/// The clear objects that a ray is in: by rank, one that is higher wins where they overlap (C. M.
/// Schmidt and B. Budge, J. Graphics Tools 7, 1 (2002)).
class MediaStack {
 public:
  static constexpr std::size_t most = 8;

  /// False: it is in `most` of them.
  bool enter(std::uint8_t rank) {
    if (count_ == most) return false;
    ranks_[count_++] = rank;
    return true;
  }
  /// One of the rank, where there is one.
  void leave(std::uint8_t rank) {
    for (std::size_t i = 0; i < count_; ++i)
      if (ranks_[i] == rank) {
        ranks_[i] = ranks_[--count_];
        return;
      }
  }
  /// 0: air.
  std::uint8_t top() const {
    std::uint8_t highest = 0;
    for (std::size_t i = 0; i < count_; ++i)
      if (ranks_[i] > highest) highest = ranks_[i];
    return highest;
  }

 private:
  std::array<std::uint8_t, most> ranks_{};
  std::uint8_t count_ = 0;
};
using MediaStacks = std::array<MediaStack, lane_count>;

/// What rays have to know of what they pass: which medium they are in, what lies between two, and
/// what is not all there. Immutable, shared by threads.
class Media {
 public:
  /// The references must outlive it. Of a scene without clear objects all is air.
  Media(const RenderScene& scene, const EmbreeScene& geometry, const Cutouts& cutouts);

  /// What the eye is in.
  const MediaStack& of_eye() const { return of_eye_; }

  bool is_clear(int object) const { return ranks_[static_cast<std::size_t>(object)] > 0; }
  /// Whether the side of a clear object that was met is the outer one.
  bool is_front(int object, bool behind) const {
    return behind == inwards_[static_cast<std::size_t>(object)];
  }
  /// Whether lights reach what lies behind the object.
  bool has_clear_shadow(int object) const {
    return of_[ranks_[static_cast<std::size_t>(object)]].medium->clear_shadow;
  }

  /// What light meets that goes from one medium to another, by rank.
  struct Interface {
    std::uint32_t number;       ///< Index into RenderScene::interfaces.
    float ratio;                ///< n of the one it comes from by that of the other.
    std::vector<float> ratios;  ///< The same in each bundle; empty: it does not disperse.
    bool from_rare;             ///< It comes from the one with the lower n.
  };
  /// Null: the two have the same n at all wavelengths.
  const Interface* between(std::uint8_t from, std::uint8_t to) const {
    const auto& one = interfaces_[from * of_.size() + to];
    return one ? &*one : nullptr;
  }

  /// Bundles of wavelengths, where one of the media disperses light.
  std::uint32_t bundles() const { return bundles_; }

  /// The material of a medium, and the optical length of a unit of way in it; 0: it is clear.
  std::uint32_t material(std::uint8_t rank) const { return of_[rank].medium->material; }
  float strength(std::uint8_t rank) const { return of_[rank].strength; }
  /// The least optical length of any wavelength, relative to that.
  float weakest(std::uint8_t rank) const { return of_[rank].weakest; }

  /// Surfaces that the rays pass together, as far as rounding tells them apart.
  struct Crossing {
    Vectors beyond{};      ///< Behind all of them.
    MediaStacks inside{};  ///< What the rays are in there.
    Ints passed{};         ///< Mask of lanes that went through.
    Ints lost{};           ///< Mask of lanes that are in too many objects.
    Floats layer{};        ///< Share that is there of an opaque surface among them; 0: none is.
  };
  /// Lanes of `at.active` whose surfaces can be passed at at.hit: clear objects, and what is not
  /// all there.
  Ints passable(const Packet& at, const Hits& hits) const;
  /// Of such `lanes`. Where an opaque surface touches these it is what was hit, and takes the place
  /// in `hits`: there is no air between. One that is there by a share, the first of them, takes it
  /// too and is passed; a hole leaves it to others.
  Crossing cross(const Packet& at, Hits& hits, Ints lanes, const MediaStacks& inside) const;

 private:
  struct Medium {
    const RenderMedium* medium;
    float strength, weakest;
  };
  void rank(const RenderScene& scene);
  void find_sides(const RenderScene& scene);
  void find_eye(const RenderScene& scene);
  bool meet(const Packet& at, const Hits& met, unsigned lane, Hits& hits, Crossing& crossing) const;
  void change(int object, bool enters, unsigned lane, Crossing& crossing) const;

  const EmbreeScene& geometry_;
  const Cutouts& cutouts_;
  std::vector<Medium> of_;           ///< By rank.
  std::vector<std::uint8_t> ranks_;  ///< By object; 0: opaque.
  std::vector<bool> inwards_;        ///< By object: Embree's normals point inwards.
  std::vector<std::optional<Interface>> interfaces_;  ///< By rank and rank.
  MediaStack of_eye_;
  std::uint32_t bundles_;
};

}  // namespace metamer::cpu
