#include "common/transport/message_tables.h"

namespace metamer {

std::uint32_t MessageTables::product(std::uint32_t parent, const FactorNode& factor) {
  const auto next = static_cast<std::uint32_t>(products_.size() + 1);
  const auto [entry, is_new] = products_.try_emplace({parent, factor}, next);
  if (is_new) {
    message_.add_product_parent(parent);
    message_.add_product_material(factor.index);
    message_.add_product_term(static_cast<v1::FactorTerm>(factor.kind));
    message_.add_product_node(factor.node);
  }
  return entry->second;
}

std::uint32_t MessageTables::signature(std::uint32_t product, std::uint32_t light,
                                       const FactorNode& factor) {
  const auto next = static_cast<std::uint32_t>(signatures_.size());
  const auto [entry, is_new] = signatures_.try_emplace({product, light, factor}, next);
  if (is_new) {
    message_.add_signature_product(product);
    message_.add_signature_light(light);
    message_.add_signature_material(factor.index);
    message_.add_signature_term(static_cast<v1::FactorTerm>(factor.kind));
    message_.add_signature_node(factor.node);
  }
  return entry->second;
}

void MessageTables::clear() {
  message_.Clear();
  products_.clear();
  signatures_.clear();
}

MessageTerms::MessageTerms(const v1::TileFactors& message) : message_(message) {
  chains_.push_back({0, {FactorKind::white, 0, 0}});
  for (int i = 0; i < message.product_parent_size(); ++i)
    chains_.push_back({message.product_parent(i), product_factor(message, i)});
}

}  // namespace metamer
