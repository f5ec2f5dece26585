#include "common/mesh/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "common/mesh/vertex.h"

namespace metamer {
namespace {

using Double2 = std::array<double, 2>;

/// Twice the polygon's area as a vector, independent of the corner it begins with (Sutherland,
/// Sproull & Schumacker 1974, after Newell).
Double3 newell_normal(std::span<const Double3> corners) {
  Double3 normal{};
  const Double3& origin = corners[0];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Double3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      normal[k] +=
          (a[u] - origin[u]) * (b[v] - origin[v]) - (a[v] - origin[v]) * (b[u] - origin[u]);
    }
  }
  return normal;
}

/// Whether the polygon turns about `normal` at a corner, or goes straight on.
bool turns_along(std::span<const Double3> corners, std::size_t at, const Double3& normal) {
  const std::size_t count = corners.size();
  const Double3 &a = corners[(at + count - 1) % count], &b = corners[at],
                &c = corners[(at + 1) % count];
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    sum += normal[k] * ((b[u] - a[u]) * (c[v] - b[v]) - (b[v] - a[v]) * (c[u] - b[u]));
  }
  return sum >= 0;
}

/// The corners in a plane, where the polygon runs counterclockwise.
std::vector<Double2> in_plane(std::span<const Double3> corners, const Double3& normal) {
  const auto size = [&](std::size_t k) { return std::abs(normal[k]); };
  const std::size_t drop =
      size(0) >= size(1) ? (size(0) >= size(2) ? 0 : 2) : (size(1) >= size(2) ? 1 : 2);
  std::size_t u = (drop + 1) % 3, v = (drop + 2) % 3;
  if (normal[drop] < 0) std::swap(u, v);
  std::vector<Double2> result;
  for (const Double3& corner : corners) result.push_back({corner[u], corner[v]});
  return result;
}

/// Twice the area of a triangle, above 0 where it runs counterclockwise.
double turn(const Double2& a, const Double2& b, const Double2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool inside(const Double2& p, const Double2& a, const Double2& b, const Double2& c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

void fan(std::size_t count, std::size_t from, std::vector<Triangle>& to) {
  const auto corner = [&](std::size_t i) { return static_cast<std::uint32_t>((from + i) % count); };
  for (std::size_t i = 1; i + 1 < count; ++i) to.push_back({corner(0), corner(i), corner(i + 1)});
}

/// Cuts a concave polygon's ears one by one.
class Ears {
 public:
  explicit Ears(std::vector<Double2> points) : points_(std::move(points)), left_(points_.size()) {
    std::iota(left_.begin(), left_.end(), 0u);
  }

  void cut(std::vector<Triangle>& to) {
    std::size_t at = 0;
    while (left_.size() > 3) {
      std::size_t tries = left_.size();
      while (tries > 0 && !is_ear(at)) at = (at + 1) % left_.size(), --tries;
      // None where edges cross: any corner does.
      to.push_back({neighbour(at, -1), left_[at], neighbour(at, 1)});
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      // On past the next corner: cutting at one place again and again makes thin triangles.
      at = (at + 1) % left_.size();
    }
    to.push_back({left_[0], left_[1], left_[2]});
  }

 private:
  std::uint32_t neighbour(std::size_t at, int step) const {
    return left_[(at + left_.size() + static_cast<std::size_t>(step)) % left_.size()];
  }
  bool is_ear(std::size_t at) const {
    const Double2 &a = points_[neighbour(at, -1)], &b = points_[left_[at]],
                  &c = points_[neighbour(at, 1)];
    if (!(turn(a, b, c) > 0)) return false;
    return std::none_of(left_.begin(), left_.end(), [&](std::uint32_t other) {
      const Double2& p = points_[other];
      return p != a && p != b && p != c && inside(p, a, b, c);
    });
  }

  std::vector<Double2> points_;
  std::vector<std::uint32_t> left_;  ///< The corners that are not cut off, in their order.
};

}  // namespace

void triangulate(std::span<const Double3> corners, std::vector<Triangle>& to) {
  to.clear();
  const std::size_t count = corners.size();
  if (count < 3) return;
  const Double3 normal = newell_normal(corners);
  if (count == 3 || count > most_ears || normal == Double3{}) return fan(count, 0, to);

  // Look for a corner that turns the other way.
  std::size_t concave = 0;
  while (concave < count && turns_along(corners, concave, normal)) ++concave;

  if (concave == count) return fan(count, 0, to);
  if (count == 4) return fan(count, concave, to);
  Ears(in_plane(corners, normal)).cut(to);
}

Triangle* FaceSplitter::operator()(std::span<const std::uint32_t> face, Triangle* to) {
  if (face.size() < 3) return to;
  const auto keep = [&](const Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) *to++ = t;
  };
  if (face.size() == 3) {
    keep({face[0], face[1], face[2]});
    return to;
  }
  corners_.clear();
  for (const std::uint32_t vertex : face) corners_.push_back(position(vertices_, vertex));
  triangulate(corners_, triangles_);
  for (const Triangle& t : triangles_) keep({face[t[0]], face[t[1]], face[t[2]]});
  return to;
}

}  // namespace metamer
