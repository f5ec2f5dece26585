#include "client/tools/text/promise_text.h"

#include "client/tools/text/formatted.h"
#include "common/scene/methods.h"

namespace metamer::client {

std::optional<PromiseText> promise_text(const v1::Plan& plan, const v1::Finished& finished) {
  if (!plan.has_auto_() || !finished.has_accuracy()) return std::nullopt;
  const v1::Goal& goal = plan.auto_();
  const v1::ColorError& error = finished.accuracy().error();

  std::string text = method_text(plan.method()) + ": ";
  text += formatted(
      "ΔE00 against the reference, on %u pixels that had no part in the choice: mean "
      "%.3g, 95 %% below %.3g, at most %.3g",
      error.pixels(), error.mean(), error.percentile_95(), error.maximum());
  text += goal.has_deadline() ? formatted("; it took %.3g s, and %.3g s were asked for",
                                          finished.timing().total(), goal.deadline())
                              : formatted("; at most %.3g was asked for", goal.tolerance());
  return PromiseText{.kept = finished.accuracy().kept(), .text = std::move(text)};
}

}  // namespace metamer::client
