#include "server/methods/linear.h"

#include <gtest/gtest.h>

#include "server/plan/plan.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

TEST(LinearBasis, IsOrthonormalInItsInnerProductAndLosesWhatItSays) {
  // Cells of different widths, and one that counts for nothing.
  Eigen::VectorXd inner(5);
  inner << 1, 2, 0.5, 0, 3;
  Eigen::MatrixXd spectra(5, 4);
  spectra << 1, 0.2, 0.3, 0.9,  //
      0.5, 0.8, 0.1, 0.2,       //
      0.2, 0.1, 0.9, 0.4,       //
      0.7, 0.7, 0.7, 0.7,       //
      0.1, 0.6, 0.5, 0.3;
  for (Eigen::Index count = 1; count <= 3; ++count) {
    const LinearBasis basis = make_basis(spectra, inner, count);
    ASSERT_EQ(basis.functions.cols(), count);
    const Eigen::MatrixXd products =
        basis.functions.transpose() * inner.asDiagonal() * basis.functions;
    EXPECT_LT((products - Eigen::MatrixXd::Identity(count, count)).norm(), 1e-12);

    double lost = 0, power = 0;  // E[3.3-10]
    for (Eigen::Index i = 0; i < spectra.cols(); ++i) {
      const Eigen::VectorXd rest = spectra.col(i) - basis.functions * basis.project(spectra.col(i));
      lost += rest.cwiseAbs2().dot(inner);
      power += spectra.col(i).cwiseAbs2().dot(inner);
    }
    EXPECT_NEAR(basis.residual, lost / power, 1e-12);
  }
}

TEST(LinearBasis, HasNoMoreFunctionsThanTheSpectraSpan) {
  const Eigen::VectorXd inner = Eigen::VectorXd::Ones(6);
  Eigen::MatrixXd twins(6, 3);
  twins << 1, 2, 3, 1, 2, 3, 0, 0, 0, 4, 8, 12, 1, 2, 3, 0, 0, 0;
  EXPECT_EQ(make_basis(twins, inner, 5).functions.cols(), 1);
  EXPECT_NEAR(make_basis(twins, inner, 5).residual, 0, 1e-15);
  EXPECT_EQ(make_basis(twins.leftCols(1), inner, 5).functions.cols(), 1);
  EXPECT_EQ(make_basis(Eigen::MatrixXd::Zero(6, 3), inner, 5).functions.cols(), 0);
}

TEST(LinearBasis, ReflectsInCoefficientsAsInSpectra) {
  // With as many functions as wavelengths nothing is lost, E[3.3-6].
  const Eigen::VectorXd inner = Eigen::VectorXd::LinSpaced(4, 0.5, 2);
  const LinearBasis basis = make_basis(Eigen::MatrixXd::Identity(4, 4), inner, 4);
  Eigen::VectorXd light(4), surface(4);
  light << 1, 0.3, 2, 0.7;
  surface << 0.9, 0.1, 0.4, 0.6;
  const Eigen::VectorXd seen = basis.functions * basis.reflect(surface) * basis.project(light);
  EXPECT_LT((seen - light.cwiseProduct(surface)).norm(), 1e-12);
}

TEST(LinearBasis, IsTheSameFromProductsAsFromSpectra) {
  // Smooth spectra, as a scene's are: singular values from 1 down to 1e-9 of the largest.
  Eigen::MatrixXd spectra(100, 40);
  for (Eigen::Index i = 0; i < spectra.rows(); ++i)
    for (Eigen::Index j = 0; j < spectra.cols(); ++j)
      spectra(i, j) =
          std::exp(-std::pow((double(i) - 2.5 * double(j)) / 30, 2)) + 0.1 / (1 + double(j));
  const Eigen::VectorXd inner = Eigen::VectorXd::LinSpaced(100, 0.5, 2);
  const LinearBasis one = make_basis(spectra, inner, 8);
  const LinearBasis other = make_basis_of_products(spectra * spectra.transpose(), inner, 8);
  ASSERT_EQ(other.functions.cols(), 8);
  for (Eigen::Index i = 0; i < 8; ++i) {
    EXPECT_NEAR(other.singular_values[i], one.singular_values[i], 1e-12 * one.singular_values[0]);
    const double product = one.functions.col(i).cwiseProduct(inner).dot(other.functions.col(i));
    EXPECT_NEAR(std::abs(product), 1, 1e-6) << i;
  }
  EXPECT_NEAR(other.condition / one.condition, 1, 1e-6);
  EXPECT_NEAR(other.residual, one.residual, 1e-12);
}

const char* const scene_text = R"(
  camera { eye { z: 3 } target {} }
  light { name: "a" position { y: 2 } spectrum { standard: "F2" } luminance: 0.8 }
  light { name: "b" position { y: 1 } spectrum { standard: "A" } luminance: 0.3 }
  material {
    name: "paint" diffuseness: 0.5 specularness: 0.5 hall_greenberg {}
    diffuse { samples { wavelength: [400, 500, 600, 700] value: [0.1, 0.7, 0.2, 0.5] } }
    fresnel { conductor { metal: "Cu" } }
  }
  material { name: "tinted" mirror: 1 specular { samples { wavelength: [400, 700] value: [0.3, 0.9] } } }
  object { name: "o" material: "paint" sphere { radius: 1 } }
  object { name: "p" material: "tinted" sphere { radius: 1 } })";

Gather example() {
  Gather gather(2);
  const auto seen = gather.surface(0, 0);
  gather.weights(seen, 0) = {0.5f, 0, 0.125f};
  gather.add(0, 1, {FactorKind::fresnel, 0, 200}, 0.5f);
  const auto mirrored = gather.chain(0, {FactorKind::specular, 1, 1});
  gather.weights(gather.surface(mirrored, 0), 1) = {0.25f, 0, 0};
  return gather;
}

std::array<float, 3> seen_by(const v1::Method& method) {
  v1::Plan plan;
  *plan.mutable_method() = method;
  return test::resolve(*make_method(plan, test::compile_text(scene_text)), example());
}

TEST(Linear, ComesCloserWithEachFewFunctionsAndIsRightInTheEnd) {
  v1::Method exact;
  exact.mutable_exact();
  const auto reference = seen_by(exact);
  for (const auto weighting : {v1::Linear::NONE, v1::Linear::OBSERVER}) {
    double last = 1;
    for (const std::uint32_t bases : {2u, 4u, 8u, 14u}) {
      v1::Method linear;
      linear.mutable_linear()->set_bases(bases);
      linear.mutable_linear()->set_weighting(weighting);
      linear.mutable_linear()->set_bounce(true);
      const auto xyz = seen_by(linear);
      double error = 0;
      for (std::size_t i = 0; i < 3; ++i)
        error = std::max(error, std::abs(double{xyz[i]} / reference[i] - 1));
      EXPECT_LT(error, last) << bases;
      last = error;
    }
    EXPECT_LT(last, 2e-4);
  }
}

TEST(Linear, ThePlanTellsTheBasisAndWhereItIsShorterThanAskedFor) {
  // One light on one grey: one function.
  const RenderScene scene = test::compile_text(
      "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { standard: "
      "'E' } } material { name: 'm' diffuse { constant: 0.5 } } object { name: 'o' material: 'm' "
      "sphere { radius: 1 } }");
  v1::Settings settings;
  settings.mutable_method()->mutable_linear()->set_bases(4);
  const v1::Plan plan = make_plan(scene, settings, {.threads = 1});
  EXPECT_EQ(plan.bands(), 1u);
  EXPECT_NEAR(plan.condition(), 1, 1e-12);
  EXPECT_NEAR(plan.residual(), 0, 1e-12);
  bool told = false;
  for (const v1::Notice& notice : plan.notice())
    told |= notice.message() == "the scene's spectra span no more than 1 function";
  EXPECT_TRUE(told);
  Gather gather(1);
  gather.weights(gather.surface(0, 0), 0) = {1, 0, 0};
  EXPECT_NEAR(test::resolve(*make_method(plan, scene), gather)[1], 0.5, 1e-6);
}

}  // namespace
}  // namespace metamer
