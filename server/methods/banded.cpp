#include "server/methods/banded.h"

#include <algorithm>

#include "common/transport/fold.h"
#include "server/methods/band_loops.h"
#include "server/methods/costs.h"

namespace metamer {

namespace {

/// What a thread knows of a pixel's chains, and X Y Z of the rows that it has met.
struct Carriers : Method::Scratch {
  std::vector<float> values;               ///< The bands, by chain.
  std::vector<char> is_filled;             ///< By chain: some light is in its bands.
  std::vector<float> grey;                 ///< By chain: what it is in every band; −1: not alike.
  std::vector<std::vector<float>> colors;  ///< By row: three a light; empty: not met.
};

bool is_constant(const BandTable& table, std::size_t row) {
  const float* values = table.row(row);
  return std::all_of(values, values + table.bands(), [=](float v) { return v == values[0]; });
}

}  // namespace

std::unique_ptr<Method::Scratch> BandedMethod::make_scratch() const {
  auto carriers = std::make_unique<Carriers>();
  carriers->colors.resize(tables_.rows.rows());
  return carriers;
}

BandedMethod::BandedMethod(FactorRows rows, Tables tables, double learned)
    : rows_(std::move(rows)), tables_(std::move(tables)), learned_(learned) {
  for (std::size_t row = 0; row < tables_.rows.rows(); ++row)
    is_grey_.push_back(is_constant(tables_.rows, row));
}

double BandedMethod::preparation_cost() const {
  return learned_ +
         costs::table(tables_.rows.rows() + tables_.lights.emitted.rows(), tables_.rows.bands());
}

double BandedMethod::resolve_cost(const Gather& gather) const {
  // What comes over grey chains is looked up.
  const double loop = costs::loop(tables_.xyz.stride()),
               lights = static_cast<double>(tables_.lights.lights.rows());
  std::vector<bool> is_grey(gather.chains().size(), true);
  double loops = 0, found = 0;
  for (std::size_t i = 1; i < is_grey.size(); ++i) {
    const FactorRows::Mix mix = rows_.mix(gather.chains()[i].factor);
    is_grey[i] = is_grey[gather.chains()[i].parent];
    for (std::size_t j = 0; j < mix.count; ++j) is_grey[i] = is_grey[i] && is_grey_[mix.row[j]];
    if (!is_grey[i]) loops += 2;
  }
  if (loops > 0) loops += 3;
  for (const Gather::Surface& surface : gather.surfaces())
    (is_grey[surface.chain] ? found : loops) += lights;
  for (const Gather::Term& term : gather.terms()) (is_grey[term.chain] ? found : loops) += 1;
  return 3 * found + loops * loop;
}

/// Reflects each light at the end of a chain, and carries it back to the eye. Where the chain is
/// the same in every band, as of light straight from a surface, what comes of it is looked up.
struct BandedMethod::Fold : FoldHooks {
  const BandedMethod& method;
  Carriers& carriers;
  std::array<float, 3> xyz{};

  std::size_t bands() const { return method.tables_.xyz.stride(); }

  float* carrier(std::uint32_t chain) {
    float* values = carriers.values.data() + chain * bands();
    if (!carriers.is_filled[chain]) std::fill_n(values, bands(), 0.0f);
    carriers.is_filled[chain] = true;
    return values;
  }

  const std::vector<float>& color(std::uint32_t row) {
    std::vector<float>& own = carriers.colors[row];
    if (own.empty()) own = method.color_of(row);
    return own;
  }

  void enter(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
    if (carriers.grey[parent] < 0) return;
    const FactorRows::Mix mix = method.rows_.mix(factor);
    float grey = 0;
    for (std::size_t j = 0; j < mix.count; ++j) {
      if (!method.is_grey_[mix.row[j]]) return;
      grey += mix.weight[j] * method.tables_.rows.row(mix.row[j])[0];
    }
    carriers.grey[chain] = carriers.grey[parent] * grey;
  }

  void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
    if (carriers.grey[chain] >= 0) return lobes_as_terms(*this, chain, material, weights);
    const Tables& tables = method.tables_;
    const float* diffuse = tables.rows.row(method.rows_.diffuse(material));
    const float* specular = tables.rows.row(method.rows_.specular(material));
    float* to = carrier(chain);
    for (std::size_t light = 0; light < weights.size(); ++light)
      band_loops::add_lobes(bands(), to, tables.lights.lights.row(light), diffuse, specular,
                            weights[light]);
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    const std::uint32_t row = method.rows_.row(factor);
    if (carriers.grey[chain] < 0) {
      const LightTables& lights = method.tables_.lights;
      const auto fluorescence =
          factor.kind == FactorKind::reradiate ? method.rows_.fluorescence(row) : std::nullopt;
      return band_loops::add_term(
          bands(), carrier(chain),
          fluorescence ? lights.reradiated(light, *fluorescence) : lights.lights.row(light),
          method.tables_.rows.row(row), fluorescence ? weight * lights.luminance(light) : weight);
    }
    const float* seen = &color(row)[3 * light];
    for (std::size_t axis = 0; axis < 3; ++axis)
      xyz[axis] += carriers.grey[chain] * weight * seen[axis];
  }

  void leave(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
    if (!carriers.is_filled[chain]) return;
    band_loops::add_over(bands(), carrier(parent), carrier(chain), method.tables_.rows,
                         method.rows_.mix(factor));
  }
};

std::vector<float> BandedMethod::color_of(std::uint32_t row) const {
  std::vector<float> color;
  const LightTables& lights = tables_.lights;
  const auto fluorescence = rows_.fluorescence(row);
  for (std::size_t light = 0; light < lights.lights.rows(); ++light)
    for (std::size_t axis = 0; axis < 3; ++axis)
      color.push_back(fluorescence ? lights.luminance(light) *
                                         band_loops::dot(tables_.xyz.stride(),
                                                         lights.reradiated(light, *fluorescence),
                                                         tables_.xyz.row(axis))
                                   : band_loops::dot(tables_.xyz.stride(), lights.lights.row(light),
                                                     tables_.rows.row(row), tables_.xyz.row(axis)));
  return color;
}

std::array<float, 3> BandedMethod::resolve(const Gather& gather, float scale,
                                           Scratch& scratch) const {
  const std::size_t chains = gather.chains().size(), n = tables_.xyz.stride();
  auto& carriers = static_cast<Carriers&>(scratch);
  if (carriers.values.size() < chains * n) carriers.values.resize(chains * n);
  carriers.is_filled.assign(chains, false);
  carriers.grey.assign(chains, -1.0f);
  carriers.grey[0] = 1;
  Fold fold_hooks{{}, *this, carriers};
  fold(gather, fold_hooks);
  std::array<float, 3> xyz = fold_hooks.xyz;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (carriers.is_filled[0])
      xyz[axis] += band_loops::dot(n, carriers.values.data(), tables_.xyz.row(axis));
    xyz[axis] *= scale;
  }
  return xyz;
}

/// X Y Z of each row under each light: what is re-radiated is no product of a light and a row.
DirectTables BandedMethod::color_tables() const {
  std::vector<std::vector<float>> colors;
  for (std::uint32_t row = 0; row < rows_.size(); ++row) colors.push_back(color_of(row));
  for (const std::uint32_t material : rows_.fluorescent()) {
    const std::vector<float>& more = colors[rows_.row({FactorKind::reradiate, material, 0})];
    std::vector<float> sum = colors[rows_.diffuse(material)];
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
    colors.push_back(std::move(sum));
  }
  return tables_of_colors(colors);
}

DirectTables BandedMethod::direct_tables() const {
  if (!rows_.fluorescent().empty()) return color_tables();
  const std::size_t lights = tables_.lights.lights.rows(), bands = tables_.xyz.bands();
  BandTable sensors(3 * lights, bands);
  for (std::size_t light = 0; light < lights; ++light)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < bands; ++i)
        sensors.row(3 * light + axis)[i] =
            tables_.lights.lights.row(light)[i] * tables_.xyz.row(axis)[i];
  const std::uint32_t size = groups_of_four(bands);
  return {.size = size,
          .row_stride = size,
          .light_stride = 0,
          .sensor_stride = 3 * size,
          .values = tables_.rows.packed(),
          .sensors = sensors.packed(),
          .lights = tables_.lights.lights.packed(),
          .observer = tables_.xyz.packed()};
}

}  // namespace metamer
