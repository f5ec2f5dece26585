#include "common/lights/reference.h"

#include <cmath>
#include <cstring>

#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"

namespace metamer::lights {
namespace {
namespace f64 {
using Real = double;
using Bool = bool;
using std::max, std::min, std::sqrt;
struct Vec3 {
  double x, y, z;
};
Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double select(bool which, double yes, double no) { return which ? yes : no; }
#include "common/lights/shared_source.inc"
}  // namespace f64
}  // namespace

Incident incident(Light light, const Values<double>& values, const Eigen::Vector3d& at) {
  const auto found = f64::incident(light, values, {at.x(), at.y(), at.z()});
  return {{found.direction.x, found.direction.y, found.direction.z}, found.reach, found.weight};
}

}  // namespace metamer::lights
