#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "client/relight/factors.h"
#include "common/scene/fresnel_table.h"

/// A picture of two pixels and what it is made of, small enough to be summed by hand.
namespace metamer::client {

inline void set(v1::SampledSpectrum& spectrum, std::vector<double> nm, std::vector<double> values) {
  spectrum.mutable_nm()->Assign(nm.begin(), nm.end());
  spectrum.mutable_values()->Assign(values.begin(), values.end());
}

/// One light of equal energy, a paint, and a mirror of glass.
inline v1::SceneFactors scene() {
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
inline v1::TileFactors tile_factors() {
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

inline v1::Plan plan() {
  v1::Plan plan;
  plan.set_width(2);
  plan.set_height(1);
  return plan;
}

inline v1::Tile tile(const v1::TileFactors& factors) {
  v1::Tile tile;
  tile.set_width(2);
  tile.set_height(1);
  tile.set_factors(factors.SerializeAsString());
  return tile;
}

inline Factors build() {
  auto builder = FactorsBuilder::make(plan(), scene());
  EXPECT_TRUE(builder->add(tile(tile_factors())));
  return builder->finish();
}

}  // namespace metamer::client
