#include "client/tools/pictures/pixel_material.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace metamer::client {
namespace {

/// Index of the material of the first surface on the way from the eye; nothing: it is white, which
/// is no material's.
std::optional<std::uint32_t> first_material(const v1::TileFactors& tables, int signature) {
  std::uint32_t product = tables.signature_product(signature);
  if (product == 0) {
    if (tables.signature_term(signature) == v1::FACTOR_WHITE) return std::nullopt;
    return tables.signature_material(signature);
  }
  while (tables.product_parent(static_cast<int>(product) - 1) != 0)
    product = tables.product_parent(static_cast<int>(product) - 1);
  const int first = static_cast<int>(product) - 1;
  if (tables.product_term(first) == v1::FACTOR_WHITE) return std::nullopt;
  return tables.product_material(first);
}

}  // namespace

std::optional<std::string> pixel_material(const Factors& factors, int x, int y) {
  const std::size_t at = static_cast<std::size_t>(y) * factors.width + static_cast<std::size_t>(x);
  std::map<std::uint32_t, double> weights;
  for (std::size_t pair = at == 0 ? 0 : factors.end[at - 1]; pair < factors.end[at]; ++pair)
    if (const auto material =
            first_material(factors.tables, static_cast<int>(factors.signature[pair])))
      weights[*material] += std::abs(static_cast<double>(factors.weight[pair]));
  const auto most =
      std::max_element(weights.begin(), weights.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == weights.end() || !(most->second > 0)) return std::nullopt;
  return factors.scene.material(static_cast<int>(most->first)).name();
}

std::vector<std::string> objects_of(const v1::Scene& scene, const std::string& material) {
  std::vector<std::string> names;
  for (int i = 0; i < scene.object_size(); ++i)
    if (scene.object(i).material() == material)
      names.push_back(scene.object(i).name().empty() ? "object[" + std::to_string(i) + "]"
                                                     : scene.object(i).name());
  return names;
}

}  // namespace metamer::client
