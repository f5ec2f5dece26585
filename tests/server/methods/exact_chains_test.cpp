// `exact` over chains of mirrors, against plain sums over 0.005 nm with Fresnel's equations in
// complex numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "common/scene/fresnel_table.h"
#include "common/spectral/cie.h"
#include "tests/server/methods/lamps.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

const char* const steep_paint =
    "samples { wavelength: [400, 440, 450, 500, 531.7, 560, 590, 600, 640, 700] "
    "value: [0.1, 0.3, 0.5, 0.7, 0.6, 0.2, 0.35, 0.6, 0.1, 0.5] }";

const std::vector<std::vector<std::string>> chain_mirrors = {
    {"fresnel { conductor { metal: 'Au' } }"},
    {"fresnel { conductor { metal: 'Cu' } }"},
    {"fresnel { dielectric { medium: 'N-BK7' } }"},
    {"fresnel { conductor { metal: 'Au' } }", "fresnel { conductor { metal: 'Cu' } }"},
    {"specular { " + std::string(steep_paint) + " }"}};

/// The lamp, another one, a steep paint and mirrors.
RenderScene chain_scene(const Lamp& lamp, const std::vector<std::string>& mirrors) {
  std::string text =
      "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { " +
      text_of(samples_of(lamp)) +
      " } } light { name: 'd' position { y: 2 } spectrum { standard: 'D65' } luminance: 0.5 } "
      "material { name: 'paint' diffuse { " +
      steep_paint + " } } object { name: 'o' material: 'paint' sphere { radius: 1 } } ";
  for (std::size_t i = 0; i < mirrors.size(); ++i)
    text += "material { name: 'm" + std::to_string(i) + "' mirror: 1 " + mirrors[i] + " } ";
  return compile_text(text);
}

/// A node of the cosine's table, so that nothing is interpolated.
std::uint32_t chain_node(unsigned mirror) { return mirror % 3 == 1 ? 200 : 511 - 30 * mirror; }

/// Fresnel's equations for unpolarized light; k gives the refractive index its imaginary part.
double complex_fresnel(double cosine, std::complex<double> index) {
  const std::complex<double> inside = std::sqrt(index * index - 1.0 + cosine * cosine);
  const auto s = (cosine - inside) / (cosine + inside);
  const auto p = (index * index * cosine - inside) / (index * index * cosine + inside);
  return (std::norm(s) + std::norm(p)) / 2;
}

/// What is left of white light after more and more of a scene's surfaces, by the plain sum's
/// wavelengths.
class PlainProduct {
 public:
  explicit PlainProduct(const RenderScene& scene) : scene_(scene) {
    values_ = PlainSum::reflectance(scene.properties[scene.materials[0].diffuse]);
  }
  const std::vector<double>& values() const { return values_; }

  void reflect(const RenderMaterial& mirror, std::uint32_t node) {
    if (mirror.fresnel != FresnelKind::exact) {
      const auto own = PlainSum::reflectance(scene_.properties[mirror.specular]);
      for (std::size_t i = 0; i < own.size(); ++i) values_[i] *= own[i];
      return;
    }
    const ConstantsAt at = resample(scene_.constants[mirror.constants], PlainSum::wavelengths());
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] *= complex_fresnel(fresnel_node(node), {at.n[i], at.k.empty() ? 0.0 : at.k[i]});
  }

 private:
  const RenderScene& scene_;
  std::vector<double> values_;
};

void expect_plain_sums(const RenderScene& scene, const PlainSum& sum) {
  v1::Plan plan;
  *plan.mutable_method() = exact();
  plan.set_depth(16);
  const auto method = make_method(plan, scene);
  PlainProduct product(scene);
  Gather gather(2);
  std::uint32_t chain = 0;
  for (unsigned depth = 0; depth <= 16; ++depth) {
    if (depth > 0) {
      const std::uint32_t mirror =
          1 + depth % static_cast<std::uint32_t>(scene.materials.size() - 1);
      const RenderMaterial& material = scene.materials[mirror];
      const bool is_exact = material.fresnel == FresnelKind::exact;
      const std::uint32_t node = chain_node(depth);
      chain = gather.chain(chain, {is_exact ? FactorKind::fresnel : FactorKind::specular, mirror,
                                   is_exact ? static_cast<float>(fresnel_node(node)) : 1.0f});
      product.reflect(material, node);
    }
    if ((depth & (depth - 1)) != 0) continue;
    Gather seen = gather;
    seen.weights(seen.surface(chain, 0), 0) = {1, 0, 0};
    const auto xyz = resolve(*method, seen);
    const Xyz truth = sum(product.values());
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(xyz[axis], truth[axis], 1e-5 * (truth[1] + truth[axis]))
          << depth << " mirrors, axis " << axis;
  }
}

TEST(ExactChains, ArePlainSumsUnderLampsOfEveryKind) {
  std::vector<Lamp> all = lamps();
  all.push_back({"two lasers in one nanometre", 0.05, 0, {{532.2, 0.05, 10}, {532.7, 0.05, 10}}});
  all.push_back({"one sample a nanometre", 1, 0, {{506, 0.4, 1}}});
  for (const Lamp& lamp : all) {
    const PlainSum sum(samples_of(lamp), cie::observer_1931());
    for (const auto& mirrors : chain_mirrors) {
      SCOPED_TRACE(lamp.name + ", " + mirrors.front());
      expect_plain_sums(chain_scene(lamp, mirrors), sum);
    }
  }
}

}  // namespace
}  // namespace metamer::test
