#pragma once

#include <map>
#include <utility>
#include <vector>

#include "common/transport/factor_kinds.h"

namespace metamer {

/// The values of a scene's factors at some wavelengths, rounded to `Number`; each is made when it
/// is first asked for. Belongs to one thread.
template <class Number>
class FactorValues {
 public:
  using Values = std::vector<Number>;

  FactorValues(FactorSources sources, std::vector<double> nm)
      : sources_(std::move(sources)), nm_(std::move(nm)) {}

  /// `factor` must have a source. The answer stays where it is.
  const Values& operator()(const FactorNode& factor) {
    const auto [entry, is_new] = values_.try_emplace(factor);
    if (is_new) {
      const std::vector<double> values = table(factor.kind, factor.index)(factor.node);
      entry->second.assign(values.begin(), values.end());
    }
    return entry->second;
  }

 private:
  const FactorTable& table(FactorKind kind, std::uint32_t index) {
    const auto [entry, is_new] = tables_.try_emplace({kind, index});
    if (is_new)
      entry->second = with_kind(kind, [&]<class Kind>(Kind) {
        return Kind::Table::make(*Kind::source(sources_, index), nm_);
      });
    return entry->second;
  }

  FactorSources sources_;
  std::vector<double> nm_;
  std::map<std::pair<FactorKind, std::uint32_t>, FactorTable> tables_;
  std::map<FactorNode, Values> values_;
};

}  // namespace metamer
