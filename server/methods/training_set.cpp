#include "server/methods/training_set.h"

#include <algorithm>
#include <cmath>

#include "server/methods/scene_spectra.h"

namespace metamer {
namespace {

/// At most `most` of the columns, evenly chosen.
Eigen::MatrixXd thinned(const Eigen::MatrixXd& columns, Eigen::Index most) {
  if (columns.cols() <= most) return columns;
  Eigen::MatrixXd some(columns.rows(), std::max<Eigen::Index>(most, 0));
  for (Eigen::Index i = 0; i < some.cols(); ++i)
    some.col(i) = columns.col(i * columns.cols() / some.cols());
  return some;
}

/// So many of the blocks that they have at most `most` columns.
std::vector<Eigen::MatrixXd> thinned(std::vector<Eigen::MatrixXd> blocks, Eigen::Index most) {
  if (!blocks.empty() && blocks.front().cols() > 0)
    blocks.resize(std::min(blocks.size(), static_cast<std::size_t>(most / blocks.front().cols())));
  return blocks;
}

/// The slope of CIELAB's f (CIE 15:2004, 8.2.1) at a value relative to white.
double lab_slope(double relative) {
  constexpr double knee = 216.0 / 24389, below = 841.0 / 108;
  return relative > knee ? std::pow(relative, -2.0 / 3) / 3 : below;
}

/// What errors of light count of which the white is `white`: how L*, a* and b* change with each of
/// X, Y and Z when the three are off independently.
Eigen::Array3d importance(const Eigen::Array3d& xyz, const Eigen::Array3d& white) {
  const Eigen::Array3d lab_by_f(500, std::hypot(116, 500, 200), 200);
  // Of a light that has next to none of X or Z, no error there is seen.
  const Eigen::Array3d scale = white.max(0.01 * white[1]);
  return lab_by_f * (xyz / scale).unaryExpr(&lab_slope) / scale;
}

}  // namespace

TrainingSet make_training_set(const RenderScene& scene, const Observer& choice, Eigen::Index most) {
  const Wavelengths wavelengths = observer_wavelengths();
  const ObserverWeights observer = observer_weights(choice, wavelengths);
  const Eigen::MatrixXd lights = unit_light_columns(scene, observer, wavelengths);
  const Eigen::MatrixXd surfaces = surface_columns(scene, wavelengths);

  const std::vector<Eigen::MatrixXd> fluorescent =
      thinned(fluorescent_columns(scene, observer, wavelengths), most / 4);

  // As many surfaces as there is room for, and then as many of them in mirrors.
  const Eigen::Index count = lights.cols(), bright = static_cast<Eigen::Index>(fluorescent.size()),
                     room = count > 0 ? std::max<Eigen::Index>(most / count - 1 - bright, 0) : 0;
  const Eigen::MatrixXd once = thinned(surfaces, room);
  const Eigen::Index pairs = room - once.cols();
  const auto side = static_cast<Eigen::Index>(std::sqrt(static_cast<double>(pairs)));
  const Eigen::MatrixXd mirrors = thinned(mirror_columns(scene, wavelengths), side);
  const Eigen::MatrixXd mirrored =
      thinned(surfaces, mirrors.cols() > 0 ? pairs / mirrors.cols() : 0);
  const Eigen::Index seen_once = once.cols() + bright,
                     seen_twice = mirrors.cols() * mirrored.cols();

  TrainingSet set;
  set.whites = count;
  set.spectra.resize(lights.rows(), count * (1 + seen_once + seen_twice));
  Eigen::Index next = 0;
  const auto add = [&](const auto& factor) {
    for (Eigen::Index light = 0; light < count; ++light)
      set.spectra.col(next++) = lights.col(light).cwiseProduct(factor);
  };
  add(Eigen::VectorXd::Ones(lights.rows()));
  for (Eigen::Index i = 0; i < once.cols(); ++i) add(once.col(i));
  for (const Eigen::MatrixXd& block : fluorescent) {
    set.spectra.middleCols(next, count) = block;
    next += count;
  }
  for (Eigen::Index i = 0; i < mirrors.cols(); ++i)
    for (Eigen::Index j = 0; j < mirrored.cols(); ++j)
      add(mirrors.col(i).cwiseProduct(mirrored.col(j)));

  Eigen::MatrixXd sensitivity(lights.rows(), 3);
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    sensitivity.col(axis) = to_vector(observer.weights[static_cast<std::size_t>(axis)]);
  set.xyz = sensitivity.transpose() * set.spectra;
  set.sensitivity = sensitivity.rowwise().sum();

  // Each class as much as the others, and mirrors, which are the hardest, twice.
  set.weights.resize(3, set.spectra.cols());
  for (Eigen::Index i = 0; i < set.spectra.cols(); ++i) {
    const bool direct = i < count * (1 + seen_once);
    const Eigen::Index alike = i < count ? count : count * (direct ? seen_once : seen_twice);
    const double share = (direct ? 1 : 2) / std::sqrt(static_cast<double>(alike));
    const Eigen::Array3d counts = importance(set.xyz.col(i), set.xyz.col(i % count));
    for (Eigen::Index axis = 0; axis < 3; ++axis) set.weights(axis, i) = share * counts[axis];
  }
  return set;
}

}  // namespace metamer
