#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/color/matrix3.h"
#include "common/color/xyz.h"
#include "common/problem.h"

/// Chromatic adaptation (3.2.2): what an eye that has got used to one white would see under
/// another. All are von Kries's method E[3.2-5] on different responses.
namespace metamer {

enum class Adaptation { none, von_kries, bradford, sharp, cmccat2000 };

/// "none", "von-kries", "bradford", "sharp", "cmccat2000"; nothing for another word.
std::optional<Adaptation> find_adaptation(std::string_view word);
const std::vector<std::string>& adaptation_words();  ///< In the order of the enumeration.

/// X Y Z under the white `from` → X Y Z under the white `to`: E[3.2-5] with the ratios of the
/// whites' responses, complete adaptation (cmccat2000 without its surround). For `none`, identity.
/// Error: a white so saturated that a response to it is not above 0.
Result<Matrix3> adaptation_matrix(Adaptation adaptation, const Xyz& from, const Xyz& to);

}  // namespace metamer
