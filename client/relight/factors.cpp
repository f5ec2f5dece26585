#include "client/relight/factors.h"

#include <cmath>
#include <limits>

#include "client/relight/reradiated_lights.h"
#include "client/relight/scene_sources.h"
#include "common/scene/absorption_table.h"
#include "common/spectral/observer.h"
#include "common/transport/factor_kinds.h"
#include "common/transport/message_tables.h"

namespace metamer::client {
namespace {

bool is_spectrum(const v1::SampledSpectrum& spectrum) {
  return make_spectrum({spectrum.nm().begin(), spectrum.nm().end()},
                       {spectrum.values().begin(), spectrum.values().end()})
      .has_value();
}

/// One that absorbs something somewhere.
bool is_transmittance(const v1::SampledSpectrum& spectrum) {
  return is_spectrum(spectrum) && optical_depth(to_spectrum(spectrum)) > 0;
}

/// What is wrong with a factor; empty: nothing.
std::string factor_fault(const FactorNode& factor, const FactorSources& sources) {
  for (const FactorEntry& entry : factor_entries)
    if (entry.kind == factor.kind)
      return with_kind(factor.kind, [&]<class Kind>(Kind) -> std::string {
        if (factor.index >= Kind::count(sources)) return "names a material that does not exist";
        if (factor.node >= Kind::Table::nodes) return "names a node that does not exist";
        if (Kind::source(sources, factor.index) == nullptr)
          return std::string("names a ") + entry.title + " that does not exist";
        return {};
      });
  return "names a term that does not exist";
}

/// What is wrong with its observer; empty: it has none, or nothing.
std::string observer_fault_in(const v1::SceneFactors& scene) {
  if (scene.observer().empty()) return {};
  if (scene.observer_size() != 3) return "its observer has other than three functions";
  Observer::Functions functions;
  for (int i = 0; i < 3; ++i) {
    if (!is_spectrum(scene.observer(i))) return "its observer has no sound spectra";
    functions[static_cast<std::size_t>(i)] = to_spectrum(scene.observer(i));
  }
  const auto fault = observer_fault(functions);
  return fault ? "its observer has a fault: " + *fault : std::string();
}

}  // namespace

std::string scene_fault(const v1::SceneFactors& scene) {
  for (const auto& light : scene.light())
    if (!is_spectrum(light.power()) || !std::isfinite(light.luminance()))
      return "light \"" + light.name() + "\" has no sound spectrum";
  for (const auto& material : scene.material()) {
    const auto& constants = material.constants();
    if (material.has_fluorescence() &&
        material.fluorescence() >= static_cast<std::uint32_t>(scene.fluorescence_size()))
      return "material \"" + material.name() + "\" names a fluorescence that does not exist";
    if (!is_spectrum(material.diffuse()) || !is_spectrum(material.specular()) ||
        (material.has_constants() && !is_spectrum(constants.n())) ||
        (material.has_transmittance() && !is_transmittance(material.transmittance())) ||
        (constants.has_k() && !is_spectrum(constants.k())))
      return "material \"" + material.name() + "\" has no sound spectrum";
  }
  for (const auto& interface : scene.interface())
    if (!is_spectrum(interface.n())) return "an interface has no sound spectrum";
  for (const auto& window : scene.window())
    if (!is_spectrum(window)) return "a bundle of wavelengths has no sound spectrum";
  for (const auto& fluorescence : scene.fluorescence())
    if (std::string fault = fluorescence_fault(fluorescence); !fault.empty()) return fault;
  return observer_fault_in(scene);
}

std::string table_fault(const v1::TileFactors& tables, std::size_t lights,
                        const FactorSources& sources) {
  const int products = tables.product_parent_size(), signatures = tables.signature_product_size();
  if (tables.product_material_size() != products || tables.product_term_size() != products ||
      tables.product_node_size() != products || tables.signature_light_size() != signatures ||
      tables.signature_material_size() != signatures ||
      tables.signature_term_size() != signatures || tables.signature_node_size() != signatures)
    return "the lists of its tables differ in length";
  for (int i = 0; i < products; ++i) {
    if (tables.product_parent(i) > static_cast<std::uint32_t>(i))
      return "a product comes before its parent";
    const std::string fault = factor_fault(MessageTerms::product_factor(tables, i), sources);
    if (!fault.empty()) return "a product " + fault;
    if (tables.product_term(i) == v1::FACTOR_RERADIATE) return "a product re-radiates";
  }
  for (int i = 0; i < signatures; ++i) {
    if (tables.signature_product(i) > static_cast<std::uint32_t>(products))
      return "a signature names a product that does not exist";
    if (tables.signature_light(i) >= lights) return "a signature names a light that does not exist";
    const std::string fault = factor_fault(MessageTerms::signature_factor(tables, i), sources);
    if (!fault.empty()) return "a signature " + fault;
  }
  return {};
}

/// The picture's tables under way, and what their factors are made of.
struct FactorsBuilder::Tables {
  MessageTables all;
  SceneSources sources;
};

FactorsBuilder::FactorsBuilder(const v1::Plan& plan, const v1::SceneFactors& scene)
    : tables_(std::make_shared<Tables>(Tables{MessageTables{}, SceneSources(scene)})) {
  factors_.plan = plan;
  factors_.scene = scene;
  factors_.width = plan.width();
  factors_.height = plan.height();
}

Result<FactorsBuilder> FactorsBuilder::make(const v1::Plan& plan, const v1::SceneFactors& scene) {
  if (const std::string fault = scene_fault(scene); !fault.empty()) return problem(fault);
  return FactorsBuilder(plan, scene);
}

std::vector<std::uint32_t> FactorsBuilder::add_tables(const v1::TileFactors& tile) {
  std::vector<std::uint32_t> products{0}, signatures;
  MessageTables& all = tables_->all;
  for (int i = 0; i < tile.product_parent_size(); ++i)
    products.push_back(
        all.product(products[tile.product_parent(i)], MessageTerms::product_factor(tile, i)));
  for (int i = 0; i < tile.signature_product_size(); ++i)
    signatures.push_back(all.signature(products[tile.signature_product(i)], tile.signature_light(i),
                                       MessageTerms::signature_factor(tile, i)));
  return signatures;
}

Result<void> FactorsBuilder::add(const v1::Tile& tile) {
  v1::TileFactors own;
  if (tile.factors().empty() || !own.ParseFromString(tile.factors()))
    return problem("a tile came without its factors");
  if (tile.x() >= factors_.width || tile.width() > factors_.width - tile.x() ||
      tile.y() >= factors_.height || tile.height() > factors_.height - tile.y())
    return problem("a tile lies outside the picture");
  if (const std::string fault = table_fault(
          own, static_cast<std::size_t>(factors_.scene.light_size()), tables_->sources.factors());
      !fault.empty())
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
  const auto numbers = add_tables(own);
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
  factors_.tables = std::move(tables_->all.message());
  return std::move(factors_);
}

}  // namespace metamer::client
