#include "common/mesh/obj/corner_vertices.h"

#include <boost/unordered/unordered_flat_map.hpp>

namespace metamer::obj {
namespace {

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::size_t seed = 0;
    boost::hash_combine(seed, corner.v);
    boost::hash_combine(seed, corner.vt);
    boost::hash_combine(seed, corner.vn);
    return seed;
  }
};

}  // namespace

std::vector<Corner> join_corners(std::vector<Faces>& pieces, std::size_t positions) {
  std::vector<Corner> corners;
  std::vector<std::uint32_t> first(positions, none);  // Of each v; most have no other.
  boost::unordered_flat_map<Corner, std::uint32_t, CornerHash> others;
  for (Faces& faces : pieces)
    for (std::size_t i = 0; i < faces.v.size(); ++i) {
      const Corner corner{faces.v[i], faces.vt.empty() ? none : faces.vt[i],
                          faces.vn.empty() ? none : faces.vn[i]};
      const auto next = static_cast<std::uint32_t>(corners.size());
      std::uint32_t& known = first[corner.v];
      if (known == none) known = next;
      std::uint32_t number = known;
      if (known != next && corners[known] != corner)
        number = others.try_emplace(corner, next).first->second;
      if (number == next) corners.push_back(corner);
      faces.v[i] = number;
    }
  return corners;
}

}  // namespace metamer::obj
