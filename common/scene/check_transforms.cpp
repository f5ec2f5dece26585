#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/scene/limits.h"
#include "common/scene/parts.h"
#include "common/scene/vectors.h"

namespace metamer {

namespace {

/// Three rows of three; the translation does not matter here.
using Linear = std::array<Vector, 3>;

constexpr Linear identity = {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};

Linear operator*(const Linear& a, const Linear& b) {
  const auto row = [&](Vector v) {
    return Vector{v.x * b[0].x + v.y * b[1].x + v.z * b[2].x,
                  v.x * b[0].y + v.y * b[1].y + v.z * b[2].y,
                  v.x * b[0].z + v.y * b[1].z + v.z * b[2].z};
  };
  return {row(a[0]), row(a[1]), row(a[2])};
}

double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// The determinant of the rows made unit vectors, in 0..1: below parallel_sine² the rows lie in a
/// plane as far as f32 can tell.
bool is_singular(const Linear& m) {
  for (const Vector& row : m) {
    if (length(row) == 0) return true;
  }
  const double volume = dot(unit(m[0]), cross(unit(m[1]), unit(m[2])));
  return std::abs(volume) < parallel_sine * parallel_sine;
}

/// By Rodrigues' formula.
Linear rotation(const v1::Rotation& rotate) {
  const Vector a = unit(to_vector(rotate.axis()));
  const double angle = rotate.degrees() * std::numbers::pi / 180;
  const double c = std::cos(angle), s = std::sin(angle), t = 1 - c;
  return {Vector{t * a.x * a.x + c, t * a.x * a.y - s * a.z, t * a.x * a.z + s * a.y},
          Vector{t * a.x * a.y + s * a.z, t * a.y * a.y + c, t * a.y * a.z - s * a.x},
          Vector{t * a.x * a.z - s * a.y, t * a.y * a.z + s * a.x, t * a.z * a.z + c}};
}

/// The step's linear part; the identity and a finding where it is not valid.
Linear check_step(const v1::Transform& step, const std::string& field, Findings& findings) {
  switch (step.step_case()) {
    case v1::Transform::kTranslate:
      return identity;
    case v1::Transform::kScale: {
      const v1::Vec3& s = step.scale();
      for (const auto& [axis, factor] :
           {std::pair{"x", s.x()}, std::pair{"y", s.y()}, std::pair{"z", s.z()}}) {
        if (factor != 0) continue;
        findings.add(field + ".scale",
                     std::string("no factor of scale may be 0 (") + axis + " is)");
        return identity;
      }
      return {Vector{s.x(), 0, 0}, Vector{0, s.y(), 0}, Vector{0, 0, s.z()}};
    }
    case v1::Transform::kRotate:
      if (length(to_vector(step.rotate().axis())) > 0) return rotation(step.rotate());
      findings.add(field + ".rotate.axis", "axis must not be 0");
      return identity;
    case v1::Transform::kMatrix: {
      const auto& m = step.matrix().row_major();
      if (m.size() != 12) {
        findings.add(field + ".matrix",
                     "matrix needs 12 numbers (it has " + std::to_string(m.size()) + ")");
        return identity;
      }
      const Linear linear = {Vector{m[0], m[1], m[2]}, Vector{m[4], m[5], m[6]},
                             Vector{m[8], m[9], m[10]}};
      if (!is_singular(linear)) return linear;
      findings.add(field + ".matrix", "matrix must not be singular");
      return identity;
    }
    case v1::Transform::STEP_NOT_SET:
      findings.add(field, "transform needs a translate, a scale, a rotate or a matrix");
      return identity;
  }
  return identity;
}

}  // namespace

void check_transforms(const v1::Object& object, const std::string& field, Findings& findings) {
  const auto count = static_cast<std::size_t>(object.transform_size());
  if (count > limits::max_transforms) {
    return findings.add(indexed(field + ".transform", limits::max_transforms),
                        "an object may have at most " + std::to_string(limits::max_transforms) +
                            " transforms (it has " + std::to_string(count) + ")");
  }

  const std::size_t before = findings.size();
  Linear all = identity;
  for (std::size_t i = 0; i < count; ++i) {
    all = check_step(object.transform(static_cast<int>(i)), indexed(field + ".transform", i),
                     findings) *
          all;
  }
  if (findings.size() > before) return;

  // Steps that are valid each by itself can together stretch or squeeze beyond all numbers.
  const auto is_extreme = [](Vector row) {
    const double l = length(row);
    return !(l <= limits::max_coordinate && l >= 1 / limits::max_coordinate);
  };
  if (std::any_of(all.begin(), all.end(), is_extreme)) {
    findings.add(field + ".transform", "transforms must not stretch or squeeze by more than " +
                                           number_text(limits::max_coordinate));
  } else if (is_singular(all)) {
    findings.add(field + ".transform", "transforms must not flatten the object");
  }
}

}  // namespace metamer
