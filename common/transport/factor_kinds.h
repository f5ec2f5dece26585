#pragma once

#include <array>
#include <cstdlib>

#include "common/transport/all_factors.inc"
#include "common/transport/factor.h"

namespace metamer {

/// A line of factors.def.
struct FactorEntry {
  FactorKind kind;
  const char* name;
  const char* title;
};
inline constexpr FactorEntry factor_entries[] = {
#define METAMER_FACTOR(number, name, Type, title) {FactorKind::name, #name, title},
#include "common/transport/factors.def"
};
inline constexpr std::size_t factor_kind_count = std::size(factor_entries);

/// Tables have a column a kind.
static_assert([] {
  for (std::size_t i = 0; i < factor_kind_count; ++i)
    if (static_cast<std::size_t>(factor_entries[i].kind) != i) return false;
  return true;
}());

/// What `action` makes of the kind's definition, factors::White{} and so on.
template <class Action>
decltype(auto) with_kind(FactorKind kind, Action&& action) {
  switch (kind) {
#define METAMER_FACTOR(number, name, Type, ...) \
  case FactorKind::name:                        \
    return action(factors::Type{});
#include "common/transport/factors.def"
  }
  std::abort();  // only lines of factors.def are kinds
}

}  // namespace metamer
