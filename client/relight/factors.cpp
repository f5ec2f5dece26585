#include "client/relight/factors.h"

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "common/scene/fresnel_table.h"
#include "common/scene/limits.h"
#include "common/spectral/spectrum.h"

namespace metamer {
namespace {

using Factor = std::tuple<std::uint32_t, int, std::uint32_t>;

bool is_spectrum(const v1::SampledSpectrum& spectrum) {
  return make_spectrum({spectrum.nm().begin(), spectrum.nm().end()},
                       {spectrum.values().begin(), spectrum.values().end()})
      .has_value();
}

/// What is wrong with a factor; empty: nothing.
std::string factor_fault(std::uint32_t material, int term, std::uint32_t node,
                         const v1::SceneFactors& scene) {
  if (term == v1::FACTOR_WHITE) return {};
  if (!v1::FactorTerm_IsValid(term)) return "names a term that does not exist";
  if (material >= static_cast<std::uint32_t>(scene.material_size()))
    return "names a material that does not exist";
  if (term != v1::FACTOR_FRESNEL) return {};
  if (node >= fresnel_nodes) return "names a node that does not exist";
  if (!scene.material(static_cast<int>(material)).has_constants())
    return "names a Fresnel term that does not exist";
  return {};
}

}  // namespace

std::string scene_fault(const v1::SceneFactors& scene) {
  for (const auto& light : scene.light())
    if (!is_spectrum(light.power()) || !std::isfinite(light.luminance()))
      return "light \"" + light.name() + "\" has no sound spectrum";
  for (const auto& material : scene.material()) {
    const auto& constants = material.constants();
    if (!is_spectrum(material.diffuse()) || !is_spectrum(material.specular()) ||
        (material.has_constants() && !is_spectrum(constants.n())) ||
        (constants.has_k() && !is_spectrum(constants.k())))
      return "material \"" + material.name() + "\" has no sound spectrum";
  }
  return {};
}

std::string table_fault(const v1::TileFactors& tables, const v1::SceneFactors& scene) {
  const int products = tables.product_parent_size(), signatures = tables.signature_product_size();
  if (tables.product_material_size() != products || tables.product_term_size() != products ||
      tables.product_node_size() != products || tables.signature_light_size() != signatures ||
      tables.signature_material_size() != signatures ||
      tables.signature_term_size() != signatures || tables.signature_node_size() != signatures)
    return "the lists of its tables differ in length";
  for (int i = 0; i < products; ++i) {
    if (tables.product_parent(i) > static_cast<std::uint32_t>(i))
      return "a product comes before its parent";
    const std::string fault = factor_fault(tables.product_material(i), tables.product_term(i),
                                           tables.product_node(i), scene);
    if (!fault.empty()) return "a product " + fault;
  }
  for (int i = 0; i < signatures; ++i) {
    if (tables.signature_product(i) > static_cast<std::uint32_t>(products))
      return "a signature names a product that does not exist";
    if (tables.signature_light(i) >= static_cast<std::uint32_t>(scene.light_size()))
      return "a signature names a light that does not exist";
    const std::string fault = factor_fault(tables.signature_material(i), tables.signature_term(i),
                                           tables.signature_node(i), scene);
    if (!fault.empty()) return "a signature " + fault;
  }
  return {};
}

/// Where the picture's tables have what a tile's name.
struct FactorsBuilder::Tables {
  std::map<std::pair<std::uint32_t, Factor>, std::uint32_t> products;
  std::map<std::tuple<std::uint32_t, std::uint32_t, Factor>, std::uint32_t> signatures;
};

FactorsBuilder::FactorsBuilder(const v1::Plan& plan, const v1::SceneFactors& scene)
    : tables_(std::make_shared<Tables>()) {
  factors_.plan = plan;
  factors_.scene = scene;
  factors_.width = plan.width();
  factors_.height = plan.height();
}

Result<FactorsBuilder> FactorsBuilder::make(const v1::Plan& plan, const v1::SceneFactors& scene) {
  if (const std::string fault = scene_fault(scene); !fault.empty()) return problem(fault);
  return FactorsBuilder(plan, scene);
}

std::vector<std::uint32_t> FactorsBuilder::add_products(const v1::TileFactors& tile) {
  std::vector<std::uint32_t> numbers{0};
  v1::TileFactors& all = factors_.tables;
  for (int i = 0; i < tile.product_parent_size(); ++i) {
    const std::uint32_t parent = numbers[tile.product_parent(i)];
    const Factor factor{tile.product_material(i), tile.product_term(i), tile.product_node(i)};
    const auto next = static_cast<std::uint32_t>(tables_->products.size() + 1);
    const auto [place, is_new] = tables_->products.try_emplace({parent, factor}, next);
    if (is_new) {
      all.add_product_parent(parent);
      all.add_product_material(tile.product_material(i));
      all.add_product_term(tile.product_term(i));
      all.add_product_node(tile.product_node(i));
    }
    numbers.push_back(place->second);
  }
  return numbers;
}

std::vector<std::uint32_t> FactorsBuilder::add_signatures(
    const v1::TileFactors& tile, const std::vector<std::uint32_t>& products) {
  std::vector<std::uint32_t> numbers;
  v1::TileFactors& all = factors_.tables;
  for (int i = 0; i < tile.signature_product_size(); ++i) {
    const std::uint32_t product = products[tile.signature_product(i)];
    const Factor factor{tile.signature_material(i), tile.signature_term(i), tile.signature_node(i)};
    const auto next = static_cast<std::uint32_t>(tables_->signatures.size());
    const auto [place, is_new] =
        tables_->signatures.try_emplace({product, tile.signature_light(i), factor}, next);
    if (is_new) {
      all.add_signature_product(product);
      all.add_signature_light(tile.signature_light(i));
      all.add_signature_material(tile.signature_material(i));
      all.add_signature_term(tile.signature_term(i));
      all.add_signature_node(tile.signature_node(i));
    }
    numbers.push_back(place->second);
  }
  return numbers;
}

Result<void> FactorsBuilder::add(const v1::Tile& tile) {
  v1::TileFactors own;
  if (tile.factors().empty() || !own.ParseFromString(tile.factors()))
    return problem("a tile came without its factors");
  if (tile.x() >= factors_.width || tile.width() > factors_.width - tile.x() ||
      tile.y() >= factors_.height || tile.height() > factors_.height - tile.y())
    return problem("a tile lies outside the picture");
  if (const std::string fault = table_fault(own, factors_.scene); !fault.empty())
    return problem("of a tile's factors " + fault);

  Tile kept{tile.x(), tile.y(), tile.width(), {}, {}, {}};
  std::uint64_t pairs = 0;
  for (const std::uint32_t count : own.count()) pairs += count;
  if (own.count_size() != static_cast<std::int64_t>(std::uint64_t{tile.width()} * tile.height()) ||
      pairs != static_cast<std::uint64_t>(own.signature_size()) ||
      own.weight_size() != own.signature_size())
    return problem("a tile's factors do not fit its pixels");
  pairs_ += pairs;
  if (pairs_ > std::numeric_limits<std::uint32_t>::max())
    return problem("the picture has more than 4 G pairs of signature and weight");
  const auto numbers = add_signatures(own, add_products(own));
  kept.count.assign(own.count().begin(), own.count().end());
  kept.weight.assign(own.weight().begin(), own.weight().end());
  for (const std::uint32_t signature : own.signature()) {
    if (signature >= numbers.size())
      return problem("a pixel names a signature that does not exist");
    kept.signature.push_back(numbers[signature]);
  }
  for (const float weight : kept.weight)
    if (!std::isfinite(weight)) return problem("a pixel's weight is not finite");
  tiles_.push_back(std::move(kept));
  return {};
}

Factors FactorsBuilder::finish() {
  // Find where each pixel's pairs end, then put them there.
  const std::size_t pixels = std::size_t{factors_.width} * factors_.height;
  factors_.end.assign(pixels, 0);
  const auto for_each_pixel = [&](auto action) {
    for (const Tile& tile : tiles_) {
      std::size_t first = 0;
      for (std::size_t i = 0; i < tile.count.size(); ++i) {
        action(tile, (tile.y + i / tile.width) * factors_.width + tile.x + i % tile.width, first,
               tile.count[i]);
        first += tile.count[i];
      }
    }
  };
  for_each_pixel([&](const Tile&, std::size_t pixel, std::size_t, std::uint32_t count) {
    factors_.end[pixel] = count;
  });
  std::uint32_t total = 0;
  for (std::uint32_t& end : factors_.end) end = total += end;

  factors_.signature.resize(total);
  factors_.weight.resize(total);
  for_each_pixel([&](const Tile& tile, std::size_t pixel, std::size_t first, std::uint32_t count) {
    const std::size_t to = factors_.end[pixel] - count;
    std::copy_n(tile.signature.begin() + static_cast<std::ptrdiff_t>(first), count,
                factors_.signature.begin() + static_cast<std::ptrdiff_t>(to));
    std::copy_n(tile.weight.begin() + static_cast<std::ptrdiff_t>(first), count,
                factors_.weight.begin() + static_cast<std::ptrdiff_t>(to));
  });
  tiles_.clear();
  return std::move(factors_);
}

}  // namespace metamer
