// A picture's factors: what light and paint make of them, and files and tiles that are damaged.

#include "client/relight/factors.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>

#include "client/relight/relight.h"
#include "client/relight/reradiated_lights.h"
#include "client/relight/scene_sources.h"
#include "client/relight/signature_colors.h"
#include "common/models/reference.h"
#include "common/scene/fresnel_table.h"
#include "common/transport/factor_kinds.h"
#include "common/transport/message_tables.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

void set(v1::SampledSpectrum& spectrum, std::vector<double> nm, std::vector<double> values) {
  spectrum.mutable_nm()->Assign(nm.begin(), nm.end());
  spectrum.mutable_values()->Assign(values.begin(), values.end());
}

/// One light of equal energy, a paint, and a mirror of glass.
v1::SceneFactors scene() {
  v1::SceneFactors scene;
  v1::SceneFactors::Light& light = *scene.add_light();
  light.set_name("sun");
  light.set_luminance(1);
  set(*light.mutable_power(), {360, 830}, {1, 1});
  for (const double reflectance : {0.5, 0.2}) {
    v1::SceneFactors::Material& material = *scene.add_material();
    material.set_name(reflectance == 0.5 ? "paint" : "glass");
    set(*material.mutable_diffuse(), {500}, {reflectance});
    set(*material.mutable_specular(), {500}, {1});
  }
  set(*scene.mutable_material(1)->mutable_constants()->mutable_n(), {500}, {1.5});
  return scene;
}

/// Two pixels: the paint; and the paint in the glass, met at u = 1, beside white.
v1::TileFactors tile_factors() {
  v1::TileFactors tile;
  tile.add_product_parent(0);
  tile.add_product_material(1);
  tile.add_product_term(v1::FACTOR_FRESNEL);
  tile.add_product_node(fresnel_nodes - 1);
  const auto add = [&](std::uint32_t product, std::uint32_t material, v1::FactorTerm term) {
    tile.add_signature_product(product);
    tile.add_signature_light(0);
    tile.add_signature_material(material);
    tile.add_signature_term(term);
    tile.add_signature_node(0);
  };
  add(0, 0, v1::FACTOR_DIFFUSE);
  add(1, 0, v1::FACTOR_DIFFUSE);
  add(0, 0, v1::FACTOR_WHITE);
  tile.add_count(1);
  tile.add_count(2);
  for (const std::uint32_t signature : {0u, 1u, 2u}) tile.add_signature(signature);
  for (const float weight : {0.75f, 2.0f, 0.125f}) tile.add_weight(weight);
  return tile;
}

v1::Plan plan() {
  v1::Plan plan;
  plan.set_width(2);
  plan.set_height(1);
  return plan;
}

v1::Tile tile(const v1::TileFactors& factors) {
  v1::Tile tile;
  tile.set_width(2);
  tile.set_height(1);
  tile.set_factors(factors.SerializeAsString());
  return tile;
}

Factors build() {
  auto builder = FactorsBuilder::make(plan(), scene());
  EXPECT_TRUE(builder->add(tile(tile_factors())));
  return builder->finish();
}

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

TEST(FactorsBuilder, PutsTilesTogetherWhoseTablesDiffer) {
  // The same pixels, one a tile, the right one first and its tables in another order.
  v1::TileFactors left = tile_factors(), right = tile_factors();
  left.mutable_count()->Truncate(1);
  left.mutable_signature()->Truncate(1);
  left.mutable_weight()->Truncate(1);
  right.clear_count();
  right.clear_signature();
  right.clear_weight();
  right.add_count(2);
  right.mutable_signature_product()->SwapElements(0, 2);
  right.mutable_signature_term()->SwapElements(0, 2);
  for (const std::uint32_t signature : {1u, 0u}) right.add_signature(signature);
  for (const float weight : {2.0f, 0.125f}) right.add_weight(weight);
  v1::Tile left_tile = tile(left), right_tile = tile(right);
  left_tile.set_width(1);
  right_tile.set_width(1);
  right_tile.set_x(1);

  auto builder = FactorsBuilder::make(plan(), scene());
  ASSERT_TRUE(builder->add(right_tile));
  ASSERT_TRUE(builder->add(left_tile));
  const Factors factors = builder->finish();
  EXPECT_EQ(factors.tables.product_parent_size(), 1);
  EXPECT_EQ(factors.tables.signature_product_size(), 3);
  const auto& observer = cie::observer_1931();
  EXPECT_EQ(relight(factors, scene(), observer).pixels, relight(build(), scene(), observer).pixels);
}

struct Damage {
  const char* name;
  std::function<void(v1::TileFactors&)> damage;
  const char* message;
};

class DamagedTile : public testing::TestWithParam<Damage> {};

TEST_P(DamagedTile, IsRefused) {
  v1::TileFactors damaged = tile_factors();
  GetParam().damage(damaged);
  auto builder = FactorsBuilder::make(plan(), scene());
  const auto added = builder->add(tile(damaged));
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find(GetParam().message), std::string::npos)
      << added.error().message;
}

INSTANTIATE_TEST_SUITE_P(
    Factors, DamagedTile,
    testing::Values(
        Damage{"parent", [](auto& t) { t.set_product_parent(0, 1); }, "before its parent"},
        Damage{"material", [](auto& t) { t.set_signature_material(0, 2); }, "a material"},
        Damage{"fresnel", [](auto& t) { t.set_product_material(0, 0); }, "a Fresnel term"},
        Damage{"node", [](auto& t) { t.set_product_node(0, fresnel_nodes); }, "a node"},
        Damage{"light", [](auto& t) { t.set_signature_light(0, 1); }, "a light"},
        Damage{"product", [](auto& t) { t.set_signature_product(0, 2); }, "a product"},
        Damage{"signature", [](auto& t) { t.set_signature(0, 3); }, "a signature"},
        Damage{"length", [](auto& t) { t.add_product_node(0); }, "differ in length"},
        Damage{"count", [](auto& t) { t.set_count(0, 2); }, "do not fit its pixels"},
        Damage{"wrap", [](auto& t) { t.set_count(0, 0xffffffff); }, "do not fit its pixels"},
        Damage{"nan", [](auto& t) { t.set_weight(0, std::nanf("")); }, "not finite"}),
    [](const auto& info) { return info.param.name; });

class FactorsFile : public testing::Test {
 protected:
  FactorsFile() : file_(fs::temp_directory_path() / ("factors_test_" + std::to_string(getpid()))) {
    EXPECT_TRUE(write_factors(build(), file_));
    std::ifstream in(file_, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
  }
  ~FactorsFile() override { fs::remove(file_); }

  /// Why these bytes are refused; "" where they are not.
  std::string refused(const std::string& bytes) {
    std::ofstream(file_, std::ios::binary) << bytes;
    const auto factors = read_factors(file_);
    return factors ? "" : factors.error().message;
  }

  fs::path file_;
  std::string bytes_;
};

TEST_F(FactorsFile, HoldsWhatWasWritten) {
  const auto read = read_factors(file_);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->end, build().end);
  EXPECT_EQ(read->weight, build().weight);
  EXPECT_EQ(read->tables.SerializeAsString(), build().tables.SerializeAsString());
}

TEST_F(FactorsFile, OfAnyLengthButItsOwnIsRefused) {
  for (std::size_t size = 0; size < bytes_.size(); ++size)
    EXPECT_NE(refused(bytes_.substr(0, size)), "") << size;
  EXPECT_NE(refused(bytes_ + "x"), "");
}

TEST_F(FactorsFile, WithAnyByteChangedIsRefused) {
  for (std::size_t at = 0; at < bytes_.size(); ++at) {
    std::string changed = bytes_;
    changed[at] = static_cast<char>(changed[at] ^ 0x40);
    EXPECT_NE(refused(changed), "") << at;
  }
}

TEST_F(FactorsFile, OfAnotherKindOrVersionSaysSo) {
  EXPECT_EQ(refused("no factors at all, but longer than the head of a file of factors is"),
            "is no file of factors");
  std::string newer = bytes_;
  newer[8] = 2;
  EXPECT_EQ(refused(newer), "is a file of factors of version 2; this program reads version 1");
}

}  // namespace
}  // namespace metamer::client
