#include <unordered_map>

#include "common/transport/fold.h"
#include "server/methods/costs.h"
#include "server/methods/exact_tables.h"

namespace metamer {
namespace {

/// What a thread keeps of chains: products of their rows (2 KiB each), and signatures.
constexpr std::size_t max_products = 1 << 13, max_signatures = 1 << 19;
/// A chain of factors that lie between nodes is a sum of 2 ^ factors products, up to here.
constexpr std::size_t max_parts = 16;

/// The product of the rows of a chain, by number; `direct` is that of the chain without any.
using Product = std::uint32_t;
constexpr Product direct = 0;

std::uint64_t key(Product product, std::uint32_t row) { return std::uint64_t{product} << 32 | row; }

/// A chain is a weighted sum of products.
struct Part {
  Product product;
  float weight;
};

struct Memory : Method::Scratch {
  std::vector<std::vector<float>> products;                      ///< [0] is not used.
  std::unordered_map<std::uint64_t, Product> longer;             ///< Product × row.
  std::unordered_map<std::uint64_t, std::vector<float>> colors;  ///< XYZ of product × row by light.
  std::vector<Part> parts;        ///< Of all of a pixel's chains, one after the other.
  std::vector<std::size_t> ends;  ///< Where each chain's parts end.

  /// Forgets everything before it grows too large; only between pixels.
  void bound() {
    if (products.size() < max_products && colors.size() < max_signatures) return;
    products.clear();
    longer.clear();
    colors.clear();
  }
};

class ExactSignatures : public Method {
 public:
  explicit ExactSignatures(ExactTables tables) : tables_(std::move(tables)) {}

  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Memory>(); }

  std::array<float, 3> resolve(const Gather& gather, float scale, Scratch& scratch) const override {
    auto& memory = static_cast<Memory&>(scratch);
    memory.bound();
    memory.parts.assign(1, {direct, 1});
    memory.ends.assign(1, 1);
    Fold carrier{{}, *this, memory, {}};
    fold(gather, carrier);
    for (float& value : carrier.xyz) value *= scale;
    return carrier.xyz;
  }

  DirectTables direct_tables() const override { return tables_.direct_tables(); }
  double preparation_cost() const override { return tables_.preparation_cost(); }
  double resolve_cost(const Gather& gather) const override {
    return costs::terms(gather) * 3 + costs::chains(gather) * 4 * costs::lookup;
  }

 private:
  /// Names the products of each chain, and sums what their signatures are worth.
  struct Fold : FoldHooks {
    const ExactSignatures& method;
    Memory& memory;
    std::array<float, 3> xyz;

    void enter(std::uint32_t, std::uint32_t parent, const Factor& factor) {
      const FactorRows::Mix mix = method.tables_.rows.mix(factor);
      const auto [begin, end] = parts_of(parent);
      const std::size_t first = memory.parts.size();
      for (std::size_t t = begin; t < end; ++t)
        for (std::size_t j = 0; j < mix.count; ++j) {
          if (mix.weight[j] == 0) continue;
          const Part part = memory.parts[t];
          memory.parts.push_back(
              {method.longer(part.product, mix.row[j], memory), part.weight * mix.weight[j]});
        }
      if (memory.parts.size() - first > max_parts) method.merge(first, memory);
      memory.ends.push_back(memory.parts.size());
    }

    void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
      const std::uint32_t diffuse = method.tables_.rows.diffuse(material);
      const std::uint32_t specular = method.tables_.rows.specular(material);
      const auto [begin, end] = parts_of(chain);
      for (std::size_t t = begin; t < end; ++t)
        add_lobes(memory.parts[t], diffuse, specular, weights);
    }

    void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
      const std::uint32_t row = method.tables_.rows.row(factor);
      const auto [begin, end] = parts_of(chain);
      for (std::size_t t = begin; t < end; ++t) {
        const Part& part = memory.parts[t];
        add(part.weight * weight, method.color(part.product, row, memory) + 3 * light);
      }
    }

   private:
    std::pair<std::size_t, std::size_t> parts_of(std::uint32_t chain) const {
      return {chain == 0 ? 0 : memory.ends[chain - 1], memory.ends[chain]};
    }

    void add(float weight, const float* color) {
      for (std::size_t i = 0; i < 3; ++i) xyz[i] += weight * color[i];
    }

    void add_lobes(const Part& part, std::uint32_t diffuse_row, std::uint32_t specular_row,
                   std::span<const LobeWeights> weights) {
      const float* diffuse = method.color(part.product, diffuse_row, memory);
      const float* specular = method.color(part.product, specular_row, memory);
      const float* white = method.color(part.product, FactorRows::white, memory);
      for (const LobeWeights& w : weights) {
        add(part.weight * w.diffuse, diffuse);
        if (w.specular != 0) add(part.weight * w.specular, specular);
        if (w.white != 0) add(part.weight * w.white, white);
        diffuse += 3;
        specular += 3;
        white += 3;
      }
    }
  };

  /// Makes one product of the parts from `first` on. It has no name and is met only once.
  void merge(std::size_t first, Memory& memory) const {
    std::vector<float> sum(stride());
    for (std::size_t t = first; t < memory.parts.size(); ++t) {
      const float* product = product_of(memory.parts[t].product, memory);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += memory.parts[t].weight * product[i];
    }
    memory.parts.resize(first);
    memory.parts.push_back({keep(std::move(sum), memory), 1});
  }

  static Product keep(std::vector<float> product, Memory& memory) {
    if (memory.products.empty()) memory.products.emplace_back();
    memory.products.push_back(std::move(product));
    return static_cast<Product>(memory.products.size() - 1);
  }

  const float* product_of(Product product, const Memory& memory) const {
    return product == direct ? tables_.values.row(FactorRows::white)
                             : memory.products[product].data();
  }

  Product longer(Product product, std::uint32_t row, Memory& memory) const {
    if (row == FactorRows::white) return product;
    const auto [place, is_new] = memory.longer.try_emplace(key(product, row), direct);
    if (is_new) {
      const float* shorter = product_of(product, memory);
      std::vector<float> values(shorter, shorter + stride());
      for (std::size_t i = 0; i < values.size(); ++i) values[i] *= tables_.values.row(row)[i];
      place->second = keep(std::move(values), memory);
    }
    return place->second;
  }

  /// X Y Z of a signature for each light.
  const float* color(Product product, std::uint32_t row, Memory& memory) const {
    if (product == direct) return tables_.direct_color(row);
    std::vector<float>& own = memory.colors[key(product, row)];
    if (own.empty()) {
      own.resize(tables_.lights * 3);
      tables_.measure(product_of(product, memory), row, own.data());
    }
    return own.data();
  }

  std::size_t stride() const { return tables_.values.stride(); }

  ExactTables tables_;
};

}  // namespace

std::unique_ptr<Method> make_exact_signatures(ExactTables tables) {
  return std::make_unique<ExactSignatures>(std::move(tables));
}

}  // namespace metamer
