#pragma once

#include <array>

/// Three numbers and the linear maps between them: tristimulus values, RGB, responses of cones.
namespace metamer {

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;  ///< Rows.

Vector3 multiply(const Matrix3& matrix, const Vector3& vector);
Matrix3 multiply(const Matrix3& left, const Matrix3& right);

/// The determinant must not be 0: the caller knows what makes it so.
Matrix3 invert(const Matrix3& matrix);

inline constexpr Matrix3 identity3 = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

}  // namespace metamer
