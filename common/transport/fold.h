#pragma once

#include <cstddef>
#include <cstdint>

namespace metamer {

/// The hooks that a carrier may leave out; they cost nothing then.
struct FoldHooks {
  void enter(std::uint32_t, std::uint32_t, const auto&) {}
  void leave(std::uint32_t, std::uint32_t, const auto&) {}
};

/// The one walk over light's ways to a pixel:
///
///     L = Σ_terms weight · F_1 F_2 … F_k · factor · light
///
/// where F_1 … F_k are the factors of the term's chain, the one next to the eye first. A chain is
/// its parent and one factor more; chain 0 has none, and a parent comes before its children. A
/// carrier is what light becomes on its way:
///
/// `enter(chain, parent, factor)` is called for each chain but 0, parents first: F_1 … F_k from its
/// parent's.
/// `term(chain, light, factor, weight)` is called for each term; `Terms` may hand over several at
/// once.
/// `leave(chain, parent, factor)` is called for each chain but 0, children first: what the chain
/// has summed goes over its last factor into its parent's sum.
///
/// A carrier uses enter or leave. Either keeps the order of the factors, so they need not commute.
///
/// `Terms` has chains(), a list of parents and factors by chain, and for_each_term(carrier).
template <class Terms, class Carrier>
void fold(const Terms& terms, Carrier&& carrier) {
  const auto& chains = terms.chains();
  const auto count = static_cast<std::uint32_t>(chains.size());
  for (std::uint32_t chain = 1; chain < count; ++chain)
    carrier.enter(chain, chains[chain].parent, chains[chain].factor);
  terms.for_each_term(carrier);
  for (std::uint32_t chain = count; chain-- > 1;)
    carrier.leave(chain, chains[chain].parent, chains[chain].factor);
}

}  // namespace metamer
