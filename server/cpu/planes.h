#pragma once

#include <vector>

#include "server/cpu/lanes.h"
#include "server/scene/render_scene.h"

namespace metamer::cpu {

struct Hits;
class Passed;

/// Planes that go on to the horizon: met by their equation, not by a tree, so that f32 loses no
/// strip of them however far away it is.
class Planes {
 public:
  /// An object of the scene, by its number there.
  void add(std::uint32_t number, const RenderObject& object);
  bool empty() const { return planes_.empty(); }

  /// Takes the place of what rays have hit behind one, or where nothing was, before hits.distance;
  /// its normal is not yet turned to the ray. Not of one that the rays have passed; null: none.
  void intersect(const Vectors& origin, const Vectors& direction, Ints active, const Passed* passed,
                 Hits& hits) const;
  /// The lanes of `free` whose segments, 0 < t < length, no plane cuts.
  Ints visible(const Vectors& origin, const Vectors& direction, Floats length, Ints free) const;

 private:
  struct Plane {
    int object, material;
    Vectors normal;
    Floats height;  ///< normal · point.
  };
  std::vector<Plane> planes_;
};

}  // namespace metamer::cpu
