#include "common/mesh/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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

/// Cuts a concave polygon's ears one by one. Which corners are ears is kept: a cut changes it for
/// its two neighbours alone.
class Ears {
 public:
  explicit Ears(std::vector<Double2> points)
      : points_(std::move(points)), before_(count()), after_(count()), ear_(count()) {
    for (std::uint32_t i = 0; i < count(); ++i) {
      before_[i] = (i + count() - 1) % count();
      after_[i] = (i + 1) % count();
    }
    for (std::uint32_t i = 0; i < count(); ++i) ear_[i] = is_ear(i);
  }

  void cut(std::vector<Triangle>& to) {
    std::uint32_t at = 0;
    for (std::uint32_t left = count(); left > 3; --left) {
      std::uint32_t tries = left;
      while (tries > 0 && !ear_[at]) at = after_[at], --tries;
      // None where edges cross: any corner does.
      const std::uint32_t a = before_[at], c = after_[at];
      to.push_back({a, at, c});
      after_[a] = c;
      before_[c] = a;
      ear_[a] = is_ear(a);
      ear_[c] = is_ear(c);
      // On past the next corner: cutting at one place again and again makes thin triangles.
      at = after_[c];
    }
    to.push_back({before_[at], at, after_[at]});
  }

 private:
  std::uint32_t count() const { return static_cast<std::uint32_t>(points_.size()); }
  bool is_ear(std::uint32_t at) const {
    const Double2 &a = points_[before_[at]], &b = points_[at], &c = points_[after_[at]];
    if (!(turn(a, b, c) > 0)) return false;
    for (std::uint32_t i = after_[after_[at]]; i != before_[at]; i = after_[i]) {
      const Double2& p = points_[i];
      if (p != a && p != b && p != c && inside(p, a, b, c)) return false;
    }
    return true;
  }

  std::vector<Double2> points_;
  std::vector<std::uint32_t> before_, after_;  ///< The corners that are left beside each.
  std::vector<char> ear_;
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
