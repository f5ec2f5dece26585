#include "common/color/srgb.h"

#include <cmath>

namespace metamer::srgb {
namespace {

// IEC 61966-2-1, table 1 and clause 5: chromaticities of the primaries and of the white.
struct Chromaticity {
  double x, y;
};
constexpr std::array<Chromaticity, 3> primaries = {{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}};
constexpr Chromaticity white = {0.3127, 0.3290};

// The transfer function is a line of slope 12.92 up to here, a power above.
constexpr double knee = 0.0031308;
constexpr double slope = 12.92;

/// X, Y, Z of a chromaticity at Y = 1.
constexpr std::array<double, 3> xyz_of(Chromaticity c) {
  return {c.x / c.y, 1.0, (1 - c.x - c.y) / c.y};
}

std::array<double, 3> multiply(const Matrix3& m, const std::array<double, 3>& v) {
  std::array<double, 3> result{};
  for (std::size_t row = 0; row < 3; ++row) {
    result[row] = m[row][0] * v[0] + m[row][1] * v[1] + m[row][2] * v[2];
  }
  return result;
}

/// By cofactors: their transpose over the determinant.
Matrix3 invert(const Matrix3& m) {
  Matrix3 result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t r1 = (j + 1) % 3, r2 = (j + 2) % 3, c1 = (i + 1) % 3, c2 = (i + 2) % 3;
      result[i][j] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    }
  }
  const double determinant =
      m[0][0] * result[0][0] + m[0][1] * result[1][0] + m[0][2] * result[2][0];
  for (auto& row : result) {
    for (double& value : row) value /= determinant;
  }
  return result;
}

/// The primaries as columns, each scaled so that R = G = B = 1 gives the white.
Matrix3 derive() {
  Matrix3 columns{};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::array<double, 3> primary = xyz_of(primaries[c]);
    for (std::size_t row = 0; row < 3; ++row) columns[row][c] = primary[row];
  }
  const std::array<double, 3> scale = multiply(invert(columns), xyz_of(white));
  for (auto& row : columns) {
    for (std::size_t c = 0; c < 3; ++c) row[c] *= scale[c];
  }
  return columns;
}

}  // namespace

const Matrix3& to_xyz_matrix() {
  static const Matrix3 matrix = derive();
  return matrix;
}

const Matrix3& from_xyz_matrix() {
  static const Matrix3 matrix = invert(to_xyz_matrix());
  return matrix;
}

Rgb from_xyz(const Xyz& xyz) { return multiply(from_xyz_matrix(), xyz); }
Xyz to_xyz(const Rgb& linear) { return multiply(to_xyz_matrix(), linear); }

double encode(double linear) {
  const double size = std::abs(linear);
  const double encoded = size <= knee ? slope * size : 1.055 * std::pow(size, 1 / 2.4) - 0.055;
  return std::copysign(encoded, linear);
}

double decode(double encoded) {
  const double size = std::abs(encoded);
  const double linear = size <= slope * knee ? size / slope : std::pow((size + 0.055) / 1.055, 2.4);
  return std::copysign(linear, encoded);
}

}  // namespace metamer::srgb
