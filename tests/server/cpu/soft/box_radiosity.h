#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace metamer::test {

/// What is seen in a closed box of 1 m whose walls (x = 0, x = 1, y = 0, y = 1, z = 0, z = 1) are
/// diffuse, and whose ceiling (y = 1) shines with radiance 10, and reflects nothing, within 0.4 to
/// 0.6 of x and z. By the radiosity equation on patches (C. M. Goral et al., 1984), collocated at
/// their middles, with the closed form for the form factor of a polygon (J. H. Lambert, 1760).
class BoxRadiosity {
 public:
  /// `n`, a multiple of 5: patches along a side.
  BoxRadiosity(const std::array<double, 6>& albedo, int n) : albedo_(albedo) {
    for (int wall = 0; wall < 6; ++wall)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) patches_.push_back(make_patch(wall, i, j, n));
    const auto count = static_cast<Eigen::Index>(patches_.size());
    Eigen::MatrixXd reflected = Eigen::MatrixXd::Identity(count, count);
    radiance_.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Patch& to = patches_[static_cast<std::size_t>(i)];
      radiance_[i] = to.shines ? 10 : 0;
      if (to.shines) continue;
      for (Eigen::Index j = 0; j < count; ++j)
        reflected(i, j) -= albedo_[static_cast<std::size_t>(to.wall)] *
                           form_factor(to.middle, to.wall, patches_[static_cast<std::size_t>(j)]);
    }
    radiance_ = reflected.partialPivLu().solve(radiance_).eval();
  }

  /// Of a place on one of the walls that does not shine.
  double at(const Eigen::Vector3d& place) const {
    int wall = 0;
    for (int i = 0; i < 6; ++i)
      if (place[i / 2] == i % 2) wall = i;
    double sum = 0;
    for (std::size_t j = 0; j < patches_.size(); ++j)
      sum += form_factor(place, wall, patches_[j]) * radiance_[static_cast<Eigen::Index>(j)];
    return albedo_[static_cast<std::size_t>(wall)] * sum;
  }

 private:
  struct Patch {
    int wall;
    bool shines;
    Eigen::Vector3d middle;
    std::array<Eigen::Vector3d, 4> corners;
  };

  static Patch make_patch(int wall, int i, int j, int n) {
    const int axis = wall / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto place = [&](double along_u, double along_v) {
      Eigen::Vector3d p;
      p[axis] = wall % 2;
      p[u] = along_u / n;
      p[v] = along_v / n;
      return p;
    };
    const auto in_lamp = [n](int k) { return 5 * k >= 2 * n && 5 * k < 3 * n; };
    return {wall,
            wall == 3 && in_lamp(i) && in_lamp(j),
            place(i + 0.5, j + 0.5),
            {place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)}};
  }

  /// The share of its light by which a place of a wall sees a patch of another one.
  static double form_factor(const Eigen::Vector3d& place, int wall, const Patch& from) {
    if (from.wall == wall) return 0;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector3d a = from.corners[static_cast<std::size_t>(k)] - place,
                            b = from.corners[static_cast<std::size_t>((k + 1) % 4)] - place;
      const Eigen::Vector3d across = a.cross(b);
      if (across.norm() > 0) sum += across.normalized() * std::atan2(across.norm(), a.dot(b));
    }
    return std::abs(sum[wall / 2]) / (2 * std::numbers::pi);
  }

  std::array<double, 6> albedo_;
  std::vector<Patch> patches_;
  Eigen::VectorXd radiance_;
};

}  // namespace metamer::test
