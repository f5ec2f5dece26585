// A picture's factors: what light and paint make of them.

#include "client/relight/factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "client/relight/relight.h"
#include "client/relight/reradiated_lights.h"
#include "client/relight/scene_sources.h"
#include "client/relight/signature_colors.h"
#include "common/models/reference.h"
#include "common/scene/fresnel_table.h"
#include "common/transport/factor_kinds.h"
#include "common/transport/message_tables.h"
#include "tests/client/relight/some_factors.h"

namespace metamer::client {
namespace {

TEST(Relight, IsTheSumOfWeightsTimesTermsTimesTheLight) {
  const Image image = relight(build(), scene(), cie::observer_1931());
  EXPECT_NEAR(image.at(0, 0)[1], 0.75 * 0.5, 1e-6);
  const double glass = models::dielectric_fresnel(1, 1.5);
  EXPECT_NEAR(image.at(1, 0)[1], 2 * 0.5 * glass + 0.125, 1e-6);
}

TEST(Relight, TakesOtherSpectraOfTheSameNames) {
  v1::SceneFactors other = scene();
  set(*other.mutable_material(0)->mutable_diffuse(), {500}, {0.25});
  other.mutable_light(0)->set_luminance(2);
  const Image image = relight(build(), other, cie::observer_1964());
  EXPECT_NEAR(image.at(0, 0)[1], 2 * 0.75 * 0.25, 1e-6);
}

TEST(Relight, ManyPicturesAreBitForBitWhatEachIsAlone) {
  const Factors factors = build();
  std::vector<v1::SceneFactors> scenes(2 * relit_together + 1, scene());
  for (std::size_t i = 0; i < scenes.size(); ++i)
    set(*scenes[i].mutable_light(0)->mutable_power(), {360, 500, 830},
        {1, 0.1 * static_cast<double>(i), 2});
  for (const std::size_t count : {std::size_t{1}, relit_together - 1, scenes.size()}) {
    std::vector<Image> pictures(2, make_image(2, 1, {"X", "Y", "Z"}));
    pictures[0].pixels.assign(6, 7);
    relight(factors, std::span(scenes).first(count), cie::observer_1931(), pictures);
    ASSERT_EQ(pictures.size(), count);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(pictures[i].pixels, relight(factors, scenes[i], cie::observer_1931()).pixels) << i;
  }
}

TEST(Relight, ASpectrumSumsToItsColour) {
  const Wavelengths all = observer_wavelengths();
  const Factors factors = build();
  const Image spectral = relight_spectral(factors, scene(), cie::observer_1931(), all);
  const Image xyz = relight(factors, scene(), cie::observer_1931());
  const ObserverWeights weights = observer_weights(cie::observer_1931(), all);
  for (int x = 0; x < 2; ++x) {
    const float* bands = spectral.at(x, 0);
    const Xyz sum = to_xyz(weights, {bands, bands + all.size()});
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(sum[axis], xyz.at(x, 0)[axis], 2e-6);
  }
}

/// By what a factor of the scene multiplies light, the same at every wavelength.
double value_of(const FactorNode& factor) {
  switch (factor.kind) {
    case FactorKind::white:
    case FactorKind::specular:
      return 1;
    case FactorKind::reflect:
    case FactorKind::transmit:
    case FactorKind::absorb:
    case FactorKind::window:
    case FactorKind::reradiate:
    case FactorKind::lobe:
    case FactorKind::coherent:
      return 0;  // the scene has none
    case FactorKind::diffuse:
      return factor.index == 0 ? 0.5 : 0.2;
    case FactorKind::fresnel:
      return models::dielectric_fresnel(fresnel_node(factor.node), 1.5);
  }
  return 0;
}

TEST(Relight, IsTheSumOverTheWaysOfAnyTables) {
  std::mt19937 random(1);
  const auto any = [&]() -> FactorNode {
    const FactorKind kind = factor_entries[random() % factor_kind_count].kind;
    if (kind != FactorKind::diffuse && kind != FactorKind::specular && kind != FactorKind::fresnel)
      return {FactorKind::white, 0, 0};
    if (kind == FactorKind::fresnel)
      return {kind, 1, static_cast<std::uint32_t>(random() % fresnel_nodes)};
    return {kind, static_cast<std::uint32_t>(random() % 2), 0};
  };
  for (int round = 0; round < 20; ++round) {
    // Two pixels share the signatures of products of 0 to 8 factors.
    MessageTables tables;
    std::vector<double> products{1}, signatures;
    std::vector<std::size_t> lengths{0};
    for (int i = 0; i < 40; ++i) {
      const auto parent = static_cast<std::uint32_t>(random() % products.size());
      const FactorNode factor = any();
      if (lengths[parent] < 8 && tables.product(parent, factor) == products.size()) {
        products.push_back(products[parent] * value_of(factor));
        lengths.push_back(lengths[parent] + 1);
      }
      const auto product = static_cast<std::uint32_t>(random() % products.size());
      const FactorNode last = any();
      if (tables.signature(product, 0, last) == signatures.size())
        signatures.push_back(products[product] * value_of(last));
    }
    double expected[2] = {0, 0};
    v1::TileFactors factors = tables.message();
    for (double& sum : expected) {
      factors.add_count(static_cast<std::uint32_t>(signatures.size()));
      for (std::uint32_t i = 0; i < signatures.size(); ++i) {
        const float weight = static_cast<float>(random() % 1000) / 1000;
        factors.add_signature(i);
        factors.add_weight(weight);
        sum += double{weight} * signatures[i];
      }
    }
    auto builder = FactorsBuilder::make(plan(), scene());
    ASSERT_TRUE(builder->add(tile(factors)));
    const Image image = relight(builder->finish(), scene(), cie::observer_1931());
    for (int x = 0; x < 2; ++x) EXPECT_NEAR(image.at(x, 0)[1] / expected[x], 1, 2e-6) << round;
  }
}

/// The paint absorbs all light from 400 to 500 nm, and makes as many photons of it, at each
/// wavelength from 540 to 560 nm alike in power.
v1::SceneFactors glowing_scene() {
  v1::SceneFactors glowing = scene();
  v1::SampledFluorescence& glow = *glowing.add_fluorescence();
  set(*glow.mutable_excitation(), {400, 500}, {1, 1});
  set(*glow.mutable_emission(), {540, 560}, {1, 1});
  glow.set_quantum_yield(1);
  set(*glowing.mutable_material(0)->mutable_diffuse(), {500}, {0.05});
  glowing.mutable_material(0)->set_fluorescence(0);
  return glowing;
}

TEST(Relight, KnowsWhatIsReradiated) {
  v1::TileFactors tables = tile_factors();
  tables.set_signature_term(0, v1::FACTOR_RERADIATE);
  const auto color = [&](const v1::SceneFactors& scene) {
    return signature_colors(tables, scene, cie::observer_1931())[0].value[1];
  };
  // ∫ μ dμ / ∫ λ dλ over both ranges, seen as ȳ over its integral sees it.
  const Spectrum& y = cie::observer_1931().functions()[1];
  double seen = 0, all = 0;
  for (double nm = 360.05; nm < 830; nm += 0.1) {
    const double value = resample(y, {nm}, Outside::zero).values[0];
    all += value;
    if (nm > 540 && nm < 560) seen += value;
  }
  const double expected = 100 * 450.0 / (20 * 550.0) * seen / all;
  EXPECT_NEAR(color(glowing_scene()), expected, 1e-4 * expected);
  v1::SceneFactors by_red = glowing_scene();
  set(*by_red.mutable_light(0)->mutable_power(), {600, 700}, {1, 1});
  EXPECT_EQ(color(by_red), 0);
  EXPECT_EQ(energy_fault(glowing_scene()), "");
  v1::SceneFactors white = glowing_scene();
  set(*white.mutable_material(0)->mutable_diffuse(), {500}, {0.5});
  EXPECT_EQ(energy_fault(white).find("of \"paint\" more light comes out than in at 500 nm"), 0u);
}

/// Node by node: a cosine's and a wavelength's, whose polynomials sum to 1; and a depth's.
TEST(Relight, KnowsRoughLobesAndMirrors) {
  v1::SceneFactors rough = scene();
  rough.mutable_material(1)->set_rough(true);
  const auto brightness = [&](v1::FactorTerm term, std::uint32_t node) {
    v1::TileFactors tables = tile_factors();
    tables.set_signature_material(0, 1);
    tables.set_signature_term(0, term);
    tables.set_signature_node(0, node);
    EXPECT_EQ(table_fault(tables, 1, SceneSources(rough).factors()), "");
    return signature_colors(tables, rough, cie::observer_1931())[0].value[1];
  };
  double sum = 0;
  for (std::uint32_t w = 0; w < 8; ++w) sum += brightness(v1::FACTOR_LOBE, 8 * 127 + w);
  EXPECT_NEAR(sum, models::dielectric_fresnel(1, 1.5), 1e-6);
  EXPECT_GT(brightness(v1::FACTOR_LOBE, 8 * 127 + 3), brightness(v1::FACTOR_LOBE, 8 * 127));
  EXPECT_NEAR(brightness(v1::FACTOR_COHERENT, 0), 1, 1e-6);
  EXPECT_NEAR(brightness(v1::FACTOR_COHERENT, 511), 0, 1e-8);

  v1::TileFactors tables = tile_factors();
  tables.set_signature_material(0, 0);
  tables.set_signature_term(0, v1::FACTOR_LOBE);
  EXPECT_EQ(table_fault(tables, 1, SceneSources(rough).factors()),
            "a signature names a rough lobe that does not exist");
}

TEST(Relight, TakesNoFluorescenceThatDoesNotFit) {
  EXPECT_EQ(scene_fault(glowing_scene()), "");
  const auto fault = [](auto change) {
    v1::SceneFactors scene = glowing_scene();
    change(scene, *scene.mutable_fluorescence(0));
    return scene_fault(scene);
  };
  EXPECT_EQ(fault([](auto& scene, auto&) { scene.mutable_material(1)->set_fluorescence(1); }),
            "material \"glass\" names a fluorescence that does not exist");
  const std::string spectra = "a fluorescence has no sound spectra",
                    matrix = "a fluorescence has no sound matrix";
  EXPECT_EQ(fault([](auto&, auto& glow) { glow.set_quantum_yield(NAN); }), spectra);
  EXPECT_EQ(fault([](auto&, auto& glow) { glow.clear_excitation(); }), spectra);
  EXPECT_EQ(fault([](auto&, auto& glow) {
              set(*glow.mutable_emission(), {540, 560}, {0, 0});
            }),
            spectra);
  EXPECT_EQ(fault([](auto&, auto& glow) {
              set(*glow.mutable_emission(), {540, 560}, {-1, 2});
            }),
            spectra);
  EXPECT_EQ(fault([](auto&, auto& glow) { glow.Clear(); }), matrix);
  const auto with_matrix = [&](std::vector<double> excitation, std::vector<float> values) {
    return fault([&](auto&, auto& glow) {
      glow.Clear();
      glow.mutable_excitation_nm()->Assign(excitation.begin(), excitation.end());
      for (const double nm : {500, 600}) glow.add_emission_nm(nm);
      glow.mutable_matrix()->Assign(values.begin(), values.end());
    });
  };
  EXPECT_EQ(with_matrix({400, 500}, {0, 0, 0, 0}), "");
  EXPECT_EQ(with_matrix({500, 400}, {0, 0, 0, 0}), matrix);
  EXPECT_EQ(with_matrix({400}, {0, 0}), matrix);
  EXPECT_EQ(with_matrix({400, 500}, {0, 0, 0}), matrix);
  EXPECT_EQ(with_matrix({400, 500}, {0, 0, 0, INFINITY}), matrix);
  EXPECT_EQ(with_matrix({400, 500}, {0, 0, 0, -1}), matrix);

  const SceneSources sources(glowing_scene());
  v1::TileFactors tables = tile_factors();
  tables.set_product_material(0, 0);
  tables.set_product_term(0, v1::FACTOR_RERADIATE);
  tables.set_product_node(0, 0);
  EXPECT_EQ(table_fault(tables, 1, sources.factors()), "a product re-radiates");
  tables = tile_factors();
  tables.set_signature_material(0, 1);
  tables.set_signature_term(0, v1::FACTOR_RERADIATE);
  EXPECT_EQ(table_fault(tables, 1, sources.factors()),
            "a signature names a fluorescence that does not exist");
}

}  // namespace
}  // namespace metamer::client
