#include "server/methods/linear.h"

#include <cmath>

#include "common/color/xyz.h"
#include "common/transport/fold.h"
#include "server/methods/banded.h"
#include "server/methods/costs.h"
#include "server/methods/notices.h"
#include "server/methods/scene_spectra.h"

namespace metamer {
namespace {

/// A Aᵀ.
Eigen::MatrixXd products(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(columns.rows(), columns.rows());
  square.selfadjointView<Eigen::Lower>().rankUpdate(columns);
  square.triangularView<Eigen::StrictlyUpper>() = square.transpose();
  return square;
}

/// Carriers are coefficients, padded; `stride` of them.
class LinearMethod : public Method {
 public:
  struct Tables {
    BandTable reflected;  ///< Light × row: the coefficients of a light reflected by a row.
    BandTable matrices;   ///< Row × coefficient: the columns of a row's matrix.
    BandTable xyz;        ///< Three rows.
  };
  LinearMethod(FactorRows rows, Tables tables, std::size_t lights, std::size_t bases)
      : rows_(std::move(rows)), tables_(std::move(tables)), lights_(lights), bases_(bases) {}

  struct Carriers : Scratch {
    std::vector<float> values;
  };
  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Carriers>(); }

  std::array<float, 3> resolve(const Gather& gather, float scale, Scratch& scratch) const override {
    std::vector<float>& carriers = static_cast<Carriers&>(scratch).values;
    carriers.assign(gather.chains().size() * stride(), 0.0f);
    fold(gather, Fold{{}, *this, carriers.data()});
    std::array<float, 3> xyz{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < bases_; ++i)
        xyz[axis] += scale * tables_.xyz.row(axis)[i] * carriers[i];
    return xyz;
  }

  DirectTables direct_tables() const override {
    const std::uint32_t size = groups_of_four(bases_);
    return {.size = size,
            .row_stride = static_cast<std::uint32_t>(lights_) * size,
            .light_stride = size,
            .sensor_stride = 0,
            .values = tables_.reflected.packed(),
            .sensors = tables_.xyz.packed(),
            .lights = {},
            .observer = {}};
  }

  /// Most of it is the decomposition of a matrix of 471 rows.
  double preparation_cost() const override {
    return 6e7 + costs::table(rows_.size(), observer_wavelengths().size()) *
                     static_cast<double>(bases_ + lights_) / 4;
  }
  double resolve_cost(const Gather& gather) const override {
    return (costs::terms(gather) + 2 * static_cast<double>(bases_) * costs::chains(gather)) *
               costs::loop(stride()) +
           3 * costs::loop(bases_);
  }

 private:
  std::size_t stride() const { return tables_.xyz.stride(); }

  void add(float weight, const float* __restrict from, float* __restrict to) const {
    for (std::size_t i = 0; i < stride(); ++i) to[i] += weight * from[i];
  }

  /// Reflects each light at the end of a chain, and carries it back to the eye.
  struct Fold : FoldHooks {
    const LinearMethod& method;
    float* carriers;

    float* carrier(std::uint32_t chain) const { return carriers + chain * method.stride(); }

    void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
      lobes_as_terms(*this, chain, material, weights);
    }

    void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
      const std::size_t row = method.rows_.row(factor);
      method.add(weight, method.tables_.reflected.row(row * method.lights_ + light),
                 carrier(chain));
    }

    /// E[3.3-7], a column of a row's matrix for each coefficient that arrives.
    void leave(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
      const FactorRows::Mix mix = method.rows_.mix(factor);
      for (std::size_t j = 0; j < mix.count; ++j)
        for (std::size_t i = 0; i < method.bases_; ++i)
          method.add(mix.weight[j] * carrier(chain)[i],
                     method.tables_.matrices.row(mix.row[j] * method.bases_ + i), carrier(parent));
    }
  };

  FactorRows rows_;
  Tables tables_;
  std::size_t lights_, bases_;
};

/// A Φ(λ) of each emission and fluorescence, with Σ A² = that of the lights that have the emission.
Eigen::MatrixXd reradiated_by_lights(const RenderScene& scene, const ObserverWeights& observer) {
  std::vector<double> squares(scene.emissions.size());
  for (const RenderLight& light : scene.lights)
    squares[light.emission] += light.luminance * light.luminance;
  Eigen::MatrixXd columns = reradiated_columns(scene, observer, observer_wavelengths());
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    columns.col(i) *= std::sqrt(squares[static_cast<std::size_t>(i) / scene.fluorescences.size()]);
  return columns;
}

}  // namespace

LinearBasis scene_basis(const v1::Linear& method, const Observer& choice,
                        const RenderScene& scene) {
  const Wavelengths wavelengths = observer_wavelengths();
  const ObserverWeights observer = observer_weights(choice, wavelengths);

  // The inner product of what is light over surface is the product of both: however many lights and
  // surfaces there are, the matrix has a row and a column a wavelength.
  Eigen::MatrixXd surfaces = products(surface_columns(scene, wavelengths));
  surfaces.array() += 1;  // a light by itself, over white
  Eigen::MatrixXd gram =
      products(light_columns(scene, observer, wavelengths)).cwiseProduct(surfaces);
  if (!scene.reradiated.empty()) gram += products(reradiated_by_lights(scene, observer));
  const std::uint32_t again =
      std::max(method.bounce() ? 1U : 0U, std::min(scene.bounces, most_bounces));
  for (std::uint32_t i = 0; i < again; ++i) gram.array() *= surfaces.array();

  Eigen::VectorXd inner = to_vector(wavelengths.widths());
  if (method.weighting() == v1::Linear::OBSERVER)
    for (Eigen::Index i = 0; i < inner.size(); ++i) {
      double squares =
          0;  // of x̄ ȳ z̄; its fourth root weights a row, so its root the product of two
      for (const auto& axis : observer.weights) {
        const double value = axis[static_cast<std::size_t>(i)] / inner[i];
        squares += value * value;
      }
      inner[i] *= std::sqrt(squares);
    }
  return make_basis_of_products(gram, inner, method.bases());
}

void plan_linear(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan) {
  const v1::Linear& linear = settings.method().linear();
  const LinearBasis basis = scene_basis(linear, scene.observer, scene);
  plan.set_condition(basis.condition);
  plan.set_residual(basis.residual);
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(16, basis.singular_values.size()); ++i)
    plan.add_singular_value(basis.singular_values[i]);
  plan_found(static_cast<std::size_t>(basis.functions.cols()), linear.bases(),
             "settings.method.linear.bases", "span", "function", plan);
}

namespace {

/// What is re-radiated is a vector for each light; with diffuse, rows of DirectTables.
void add_reradiated(const RenderScene& scene, const ObserverWeights& observer,
                    const LinearBasis& basis, const FactorRows& rows, BandTable& reflected) {
  const Eigen::MatrixXd emitted = reradiated_columns(scene, observer, observer_wavelengths());
  const std::size_t count = scene.lights.size();
  for (const FactorRows::Reradiating& one : rows.reradiating())
    for (std::uint32_t light = 0; light < count; ++light)
      reflected.set(one.row * count + light,
                    to_list(scene.lights[light].luminance *
                            basis.project(emitted.col(static_cast<Eigen::Index>(
                                scene.reradiated_index(light, one.fluorescence))))));
  for (const std::uint32_t material : rows.fluorescent()) {
    const std::size_t diffuse = rows.diffuse(material),
                      own = rows.row({FactorKind::reradiate, material, 0});
    for (std::size_t light = 0; light < count; ++light)
      for (std::size_t i = 0; i < reflected.bands(); ++i)
        reflected.row(rows.direct_diffuse(material) * count + light)[i] =
            reflected.row(diffuse * count + light)[i] + reflected.row(own * count + light)[i];
  }
}

}  // namespace

std::unique_ptr<Method> make_linear(const v1::Plan& plan, const RenderScene& scene) {
  const Observer& choice = scene.observer;
  const Wavelengths wavelengths = observer_wavelengths();
  const ObserverWeights observer = observer_weights(choice, wavelengths);
  const LinearBasis basis = scene_basis(plan.method().linear(), choice, scene);
  const auto bases = static_cast<std::size_t>(basis.functions.cols());
  const Eigen::MatrixXd lights = light_columns(scene, observer, wavelengths);

  FactorRows rows(scene);
  const std::size_t count = scene.lights.size();
  BandTable reflected((rows.size() + rows.fluorescent().size()) * count, bases);
  BandTable matrices(rows.size() * bases, bases);
  rows.for_each(scene, wavelengths.nm(), [&](std::uint32_t row, const std::vector<double>& at) {
    const Eigen::VectorXd values = to_vector(at);
    for (std::size_t light = 0; light < count; ++light)
      reflected.set(row * count + light, to_list(basis.project(values.cwiseProduct(
                                             lights.col(static_cast<Eigen::Index>(light))))));
    const Eigen::MatrixXd matrix = basis.reflect(values);
    for (std::size_t i = 0; i < bases; ++i)
      matrices.set(row * bases + i, to_list(matrix.col(static_cast<Eigen::Index>(i))));
  });

  add_reradiated(scene, observer, basis, rows, reflected);

  BandTable xyz(3, bases);
  for (std::size_t axis = 0; axis < 3; ++axis)
    xyz.set(axis, to_list(basis.functions.transpose() * to_vector(observer.weights[axis])));
  return std::make_unique<LinearMethod>(
      std::move(rows),
      LinearMethod::Tables{std::move(reflected), std::move(matrices), std::move(xyz)}, count,
      bases);
}

}  // namespace metamer
