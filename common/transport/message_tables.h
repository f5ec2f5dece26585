#pragma once

#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "common/transport/factor.h"
#include "metamer/v1/factors.pb.h"

namespace metamer {

/// The products and signatures of a v1::TileFactors, as they are written: each once, numbered as
/// they come.
class MessageTables {
 public:
  /// Both give the number. `parent` and `product`: 0, or one that product() gave.
  std::uint32_t product(std::uint32_t parent, const FactorNode& factor);
  std::uint32_t signature(std::uint32_t product, std::uint32_t light, const FactorNode& factor);

  std::size_t signatures() const { return signatures_.size(); }
  v1::TileFactors& message() { return message_; }
  void clear();

 private:
  v1::TileFactors message_;
  std::map<std::pair<std::uint32_t, FactorNode>, std::uint32_t> products_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, FactorNode>, std::uint32_t> signatures_;
};

/// The same as they are read: what fold() walks over. A product is a chain, and a signature is a
/// term whose weight is 1. The message is sound, and outlives it.
class MessageTerms {
 public:
  struct Chain {
    std::uint32_t parent;
    FactorNode factor;
  };
  explicit MessageTerms(const v1::TileFactors& message);

  const std::vector<Chain>& chains() const { return chains_; }
  template <class Carrier>
  void for_each_term(Carrier& carrier) const {
    for (int i = 0; i < message_.signature_product_size(); ++i)
      carrier.term(message_.signature_product(i), message_.signature_light(i),
                   signature_factor(message_, i), 1.0f);
  }

  static FactorNode product_factor(const v1::TileFactors& message, int i) {
    return {static_cast<FactorKind>(message.product_term(i)), message.product_material(i),
            message.product_node(i)};
  }
  static FactorNode signature_factor(const v1::TileFactors& message, int i) {
    return {static_cast<FactorKind>(message.signature_term(i)), message.signature_material(i),
            message.signature_node(i)};
  }

 private:
  const v1::TileFactors& message_;
  std::vector<Chain> chains_;
};

}  // namespace metamer
