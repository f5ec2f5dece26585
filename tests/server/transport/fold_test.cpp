// What every method, the reference and the factors that are kept make of light's ways to a pixel,
// against the sum over these ways, one by one.

#include "common/transport/fold.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <map>
#include <optional>

#include "common/color/xyz.h"
#include "common/scene/absorption_table.h"
#include "common/scene/rough_mirror_table.h"
#include "common/scene/settings.h"
#include "common/spectral/wavelengths.h"
#include "server/film/factor_sink.h"
#include "server/methods/exact.h"
#include "server/methods/linear.h"
#include "server/methods/scene_spectra.h"
#include "server/plan/plan.h"
#include "server/plan/reference.h"
#include "server/transport/factor_rows.h"
#include "tests/server/methods/dense.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"
#include "tests/server/transport/closed_form.h"

namespace metamer::test {
namespace {

constexpr int gathers = 20;

/// Bands that do not mix, by a table of lights, of factors' rows and of the three sums.
template <class Light, class Row>
std::vector<double> banded(const Gather& gather, std::size_t bands, Light light, Row row) {
  std::vector<double> sum(bands);
  for (const Way& way : ways(gather)) {
    std::vector<double> carried = light(way.light), last = row(way.last);
    for (std::size_t i = 0; i < bands; ++i) carried[i] *= way.weight * last[i];
    for (const Factor& factor : way.chain) {
      std::vector<double> total(bands);
      for (const auto& [node, share] : nodes_of(factor)) {
        const std::vector<double> values = row(node);
        for (std::size_t i = 0; i < bands; ++i) total[i] += share * values[i];
      }
      for (std::size_t i = 0; i < bands; ++i) carried[i] *= total[i];
    }
    for (std::size_t i = 0; i < bands; ++i) sum[i] += carried[i];
  }
  return sum;
}

/// By a sum over narrow cells.
class NarrowCells {
 public:
  explicit NarrowCells(const RenderScene& scene)
      : scene_(scene),
        wavelengths_(dense()),
        observer_(observer_weights(cie::observer_1931(), wavelengths_)) {}

  Xyz operator()(const Gather& gather) {
    return to_xyz(observer_, banded(
                                 gather, wavelengths_.size(),
                                 [this](std::uint32_t light) { return power(light); },
                                 [this](const FactorNode& node) { return values(node); }));
  }

 private:
  const std::vector<double>& power(std::uint32_t light) {
    const auto [place, is_new] = powers_.try_emplace(light);
    if (is_new) {
      const RenderLight& own = scene_.lights[light];
      place->second =
          resample(scene_.emissions[own.emission], wavelengths_.nm(), Outside::zero).values;
      const double y = to_xyz(observer_, place->second)[1];
      for (double& value : place->second) value *= own.luminance / y;
    }
    return place->second;
  }
  const std::vector<double>& values(const FactorNode& node) {
    const auto [place, is_new] = values_.try_emplace(node);
    if (is_new) place->second = values_of(scene_, node, wavelengths_.nm());
    return place->second;
  }

  const RenderScene& scene_;
  Wavelengths wavelengths_;
  ObserverWeights observer_;
  std::map<std::uint32_t, std::vector<double>> powers_;
  std::map<FactorNode, std::vector<double>> values_;
};

/// By the bands that a method has made for a GPU, one vector a light and a row.
Xyz by_tables(const RenderScene& scene, const DirectTables& tables, const Gather& gather) {
  const FactorRows rows(scene);
  const std::size_t bands = 4 * std::size_t{tables.size};
  const auto vector = [&](const std::vector<float>& from, std::size_t index) {
    const float* first = from.data() + index * bands;
    return std::vector<double>(first, first + bands);
  };
  const std::vector<double> sum = banded(
      gather, bands, [&](std::uint32_t light) { return vector(tables.lights, light); },
      [&](const FactorNode& node) { return vector(tables.values, rows.row(node)); });
  Xyz xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<double> weights = vector(tables.observer, axis);
    for (std::size_t i = 0; i < bands; ++i) xyz[axis] += weights[i] * sum[i];
  }
  return xyz;
}

/// E[3.3-7]: a light is a vector, a factor a matrix.
class Matrices {
 public:
  Matrices(const RenderScene& scene, const v1::Linear& linear)
      : scene_(scene),
        wavelengths_(observer_wavelengths()),
        observer_(observer_weights(cie::observer_1931(), wavelengths_)),
        basis_(scene_basis(linear, cie::observer_1931(), scene)),
        lights_(light_columns(scene, observer_, wavelengths_)) {}

  Xyz operator()(const Gather& gather) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(basis_.functions.cols());
    for (const Way& way : ways(gather)) {
      Eigen::VectorXd carried =
          way.weight * basis_.project(lights_.col(way.light).cwiseProduct(values(way.last)));
      for (std::size_t i = way.chain.size(); i-- > 0;) {
        Eigen::VectorXd next = Eigen::VectorXd::Zero(carried.size());
        for (const auto& [node, share] : nodes_of(way.chain[i]))
          next += share * (matrix(node) * carried);
        carried = next;
      }
      sum += carried;
    }
    return to_xyz(observer_, to_list(basis_.functions * sum));
  }

 private:
  Eigen::VectorXd values(const FactorNode& node) const {
    return to_vector(values_of(scene_, node, wavelengths_.nm()));
  }
  const Eigen::MatrixXd& matrix(const FactorNode& node) {
    const auto [place, is_new] = matrices_.try_emplace(node);
    if (is_new) place->second = basis_.reflect(values(node));
    return place->second;
  }

  const RenderScene& scene_;
  Wavelengths wavelengths_;
  ObserverWeights observer_;
  LinearBasis basis_;
  Eigen::MatrixXd lights_;
  std::map<FactorNode, Eigen::MatrixXd> matrices_;
};

void expect_near(const std::array<float, 3>& xyz, const Xyz& expected, double tolerance) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(xyz[axis], expected[axis], tolerance * (1e-3 + std::abs(expected[1]))) << axis;
}

TEST(Fold, OfEveryMethodIsTheSumOverTheWays) {
  const RenderScene scene = transport_scene();
  for (const v1::Method& choice : all_methods()) {
    SCOPED_TRACE(choice.ShortDebugString());
    v1::Settings settings;
    *settings.mutable_method() = choice;
    settings.set_depth(8);
    const v1::Plan plan = make_plan(scene, with_defaults(settings), {.threads = 1});
    const auto method = make_method(plan, scene);
    const auto scratch = method->make_scratch();
    const DirectTables tables = method->direct_tables();
    std::optional<Matrices> matrices;
    NarrowCells narrow(scene);
    if (plan.method().has_linear()) matrices.emplace(scene, plan.method().linear());
    std::mt19937 random(1);
    for (int i = 0; i < gathers; ++i) {
      const Gather gather = random_gather(scene, random);
      const Xyz expected = matrices                    ? (*matrices)(gather)
                           : plan.method().has_exact() ? narrow(gather)
                                                       : by_tables(scene, tables, gather);
      expect_near(method->resolve(gather, 1, *scratch), expected, 2e-5);
    }
  }
}

TEST(Fold, OfTheReferenceIsTheSumOverTheWays) {
  const RenderScene scene = transport_scene();
  Reference reference(scene, cie::observer_1931());
  NarrowCells narrow(scene);
  std::mt19937 random(2);
  for (int i = 0; i < gathers; ++i) {
    const Gather gather = random_gather(scene, random);
    const Xyz xyz = reference.resolve(gather, 0.5), expected = narrow(gather);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(xyz[axis], 0.5 * expected[axis], 1e-7 * (1e-3 + std::abs(expected[1])));
  }
}

/// Of a node in its kind's table.
float place_of(const FactorNode& node) {
  if (node.kind == FactorKind::absorb) return static_cast<float>(absorption_node(node.node));
  if (node.kind == FactorKind::coherent) return static_cast<float>(rough_mirror_node(node.node));
  const bool by_cosine = node.kind == FactorKind::fresnel || node.kind == FactorKind::reflect ||
                         node.kind == FactorKind::transmit;
  const float t = static_cast<float>(node.node) / 511;
  return by_cosine ? t * t : 1;
}

TEST(Fold, OfTheFactorsThatAreKeptIsTheSumOverTheWays) {
  const RenderScene scene = transport_scene();
  struct Nothing : PixelSink {
    void take(std::uint32_t, std::uint32_t, const Gather&) override {}
  } nothing;
  NarrowCells narrow(scene);
  std::mt19937 random(3);
  for (int i = 0; i < gathers; ++i) {
    const Gather gather = random_gather(scene, random);
    FactorSink sink(nothing, 1);
    sink.begin({0, 0, 1, 1});
    sink.take(0, 0, gather);
    const v1::TileFactors kept = sink.finish();
    ASSERT_EQ(kept.count_size(), 1);

    // The same ways, with their products of nodes instead of chains.
    Gather again(scene.lights.size());
    std::vector<std::uint32_t> chains{0};
    for (int p = 0; p < kept.product_parent_size(); ++p) {
      const FactorNode node = MessageTerms::product_factor(kept, p);
      chains.push_back(
          again.chain(chains[kept.product_parent(p)], {node.kind, node.index, place_of(node)}));
    }
    for (int k = 0; k < kept.signature_size(); ++k) {
      const auto s = static_cast<int>(kept.signature(k));
      again.add(chains[kept.signature_product(s)], kept.signature_light(s),
                MessageTerms::signature_factor(kept, s), kept.weight(k));
    }
    const Xyz one = narrow(again), other = narrow(gather);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(one[axis], other[axis], 2e-6 * (1e-3 + std::abs(other[1])));
  }
}

/// A factor that is an operator on two numbers; the place is an angle, the index which of two.
Eigen::Matrix2d toy_operator(const Factor& factor) {
  Eigen::Matrix2d matrix;
  if (factor.index % 2 == 0)
    matrix << std::cos(factor.at), -std::sin(factor.at), std::sin(factor.at), std::cos(factor.at);
  else
    matrix << 1, factor.at, 0, 0.5;
  return matrix;
}
Eigen::Vector2d toy_light(std::uint32_t light, const FactorNode& factor) {
  return {1 + light, 1 + factor.index};
}

/// Multiplies from the eye.
struct FromTheEye : FoldHooks {
  std::vector<Eigen::Matrix2d> products{Eigen::Matrix2d::Identity()};
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  void enter(std::uint32_t, std::uint32_t parent, const Factor& factor) {
    products.push_back(products[parent] * toy_operator(factor));
  }
  void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
    lobes_as_terms(*this, chain, material, weights);
  }
  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    sum += products[chain] * (double{weight} * toy_light(light, factor));
  }
};

/// Carries light towards the eye.
struct TowardsTheEye : FoldHooks {
  std::vector<Eigen::Vector2d> carriers;
  void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
    lobes_as_terms(*this, chain, material, weights);
  }
  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    carriers[chain] += double{weight} * toy_light(light, factor);
  }
  void leave(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
    carriers[parent] += toy_operator(factor) * carriers[chain];
  }
};

TEST(Fold, KeepsTheOrderOfFactorsThatDoNotCommute) {
  const RenderScene scene = transport_scene();
  std::mt19937 random(4);
  double apart = 0;
  for (int i = 0; i < gathers; ++i) {
    const Gather gather = random_gather(scene, random);
    FromTheEye from;
    fold(gather, from);
    TowardsTheEye towards{
        {}, std::vector<Eigen::Vector2d>(gather.chains().size(), Eigen::Vector2d::Zero())};
    fold(gather, towards);
    Eigen::Vector2d expected = Eigen::Vector2d::Zero(), backwards = expected;
    for (const Way& way : ways(gather)) {
      Eigen::Vector2d light = way.weight * toy_light(way.light, way.last), reversed = light;
      for (std::size_t k = way.chain.size(); k-- > 0;) light = toy_operator(way.chain[k]) * light;
      for (const Factor& factor : way.chain) reversed = toy_operator(factor) * reversed;
      expected += light;
      backwards += reversed;
    }
    EXPECT_LT((from.sum - expected).norm(), 1e-12 * (1 + expected.norm()));
    EXPECT_LT((towards.carriers[0] - expected).norm(), 1e-12 * (1 + expected.norm()));
    apart = std::max(apart, (expected - backwards).norm());
  }
  EXPECT_GT(apart, 0.1);  // the operators do not commute
}

}  // namespace
}  // namespace metamer::test
