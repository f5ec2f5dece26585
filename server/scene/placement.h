#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "common/mesh/triangle_mesh.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

inline Eigen::Vector3d to_vector(const v1::Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Vector3d to_vector(const Float3& v) { return {v[0], v[1], v[2]}; }
inline Eigen::Vector3d to_vector(const Double3& v) { return {v[0], v[1], v[2]}; }

/// The box around a mesh in its own space; empty where there are none.
inline Eigen::AlignedBox3d box_of(const Positions& positions) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < positions.size(); ++i) box.extend(to_vector(positions[i]));
  return box;
}

/// Of the largest number in `m`, as a power of two; 0 where all are 0. Scaled by its inverse, the
/// largest lies in 1..2, so that no product over- or underflows, and nothing is rounded.
template <class Matrix>
int exponent_of(const Matrix& m) {
  const double largest = m.cwiseAbs().maxCoeff();
  return largest > 0 ? std::ilogb(largest) : 0;
}

/// 2^exponent m.
template <class Matrix>
typename Matrix::PlainObject scaled_by_two_to(int exponent, const Matrix& m) {
  return m.unaryExpr([exponent](double x) { return std::ldexp(x, exponent); });
}

/// `v` of length 1, whatever its length was above 0.
inline Eigen::Vector3d unit(const Eigen::Vector3d& v) {
  return scaled_by_two_to(-exponent_of(v), v).normalized();
}

/// An object's steps as one map, the first step applied first.
inline Eigen::Affine3d placement(const google::protobuf::RepeatedPtrField<v1::Transform>& steps) {
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  for (const auto& step : steps) {
    switch (step.step_case()) {
      case v1::Transform::kTranslate:
        map.pretranslate(to_vector(step.translate()));
        break;
      case v1::Transform::kScale:
        map.prescale(to_vector(step.scale()));
        break;
      case v1::Transform::kRotate: {
        constexpr double radians = std::numbers::pi / 180;
        map.prerotate(Eigen::AngleAxisd(step.rotate().degrees() * radians,
                                        unit(to_vector(step.rotate().axis()))));
        break;
      }
      case v1::Transform::kMatrix: {
        Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
        for (int row = 0; row < 3; ++row)
          for (int column = 0; column < 4; ++column)
            matrix(row, column) = step.matrix().row_major(row * 4 + column);
        map = matrix * map;
        break;
      }
      case v1::Transform::STEP_NOT_SET:
        break;
    }
  }
  return map;
}

}  // namespace metamer
