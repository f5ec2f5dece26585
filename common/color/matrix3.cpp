#include "common/color/matrix3.h"

namespace metamer {

Vector3 multiply(const Matrix3& m, const Vector3& v) {
  Vector3 result{};
  for (std::size_t row = 0; row < 3; ++row)
    result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  return result;
}

Matrix3 multiply(const Matrix3& left, const Matrix3& right) {
  Matrix3 result{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      for (std::size_t i = 0; i < 3; ++i) result[row][column] += left[row][i] * right[i][column];
  return result;
}

Matrix3 invert(const Matrix3& m) {
  // By cofactors: their transpose over the determinant.
  Matrix3 result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t r1 = (j + 1) % 3, r2 = (j + 2) % 3, c1 = (i + 1) % 3, c2 = (i + 2) % 3;
      result[i][j] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    }
  }
  const double determinant =
      m[0][0] * result[0][0] + m[0][1] * result[1][0] + m[0][2] * result[2][0];
  for (auto& row : result)
    for (double& value : row) value /= determinant;
  return result;
}

}  // namespace metamer
