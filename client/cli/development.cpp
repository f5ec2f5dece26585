#include "client/cli/development.h"

#include <algorithm>

#include "common/scene/development.h"

namespace metamer::cli {
namespace {

Result<void> apply_adaptation(const std::string& word, v1::Development& development) {
  for (int value = 0; value < v1::Adaptation_ARRAYSIZE; ++value) {
    const auto adaptation = static_cast<v1::Adaptation>(value);
    if (find_adaptation(word) != to_adaptation(adaptation)) continue;
    development.set_adaptation(adaptation);
    return {};
  }
  return problem("--adapt: no adaptation named " + quoted(word) +
                 did_you_mean(word, adaptation_words()));
}

Result<void> apply_space(const std::string& word, v1::Development& development) {
  for (int value = 0; value < v1::RgbSpace_ARRAYSIZE; ++value) {
    const auto space = static_cast<v1::RgbSpace>(value);
    if (rgb_space(to_standard_space(space)).word != word) continue;
    development.set_rgb_space(space);
    return {};
  }
  return problem("--rgb: no RGB space named " + quoted(word) +
                 did_you_mean(word, rgb_space_words()));
}

}  // namespace

Result<std::vector<std::string>> apply(const DevelopmentOptions& options,
                                       v1::Development& development) {
  std::vector<std::string> given;
  Result<void> done;
  if (options.adaptation) {
    done = apply_adaptation(*options.adaptation, development);
    given.emplace_back("--adapt");
  }
  if (done && options.rgb) {
    done = apply_space(*options.rgb, development);
    given.emplace_back("--rgb");
  }
  if (!done) return tl::unexpected(std::move(done.error()));
  if (options.linear) {
    development.set_linear(true);
    given.emplace_back("--linear");
  }
  return given;
}

Result<PlannedDeveloping> planned_developing(const v1::Plan& plan) {
  auto planned = planned_development(plan);
  if (!planned) return tl::unexpected(std::move(planned.error()));
  return PlannedDeveloping{.developing = {.space = std::move(planned->space),
                                          .adaptation = planned->adaptation,
                                          .linear = plan.development().linear()},
                           .unadapted = std::move(planned->unadapted)};
}

}  // namespace metamer::cli
