#include "client/tools/text/promise_text.h"

#include <cmath>

#include "client/tools/scene/words.h"
#include "client/tools/text/formatted.h"
#include "common/scene/methods.h"

namespace metamer::client {
namespace {

std::string looked_at(const v1::Plan& plan, const v1::ColorError& error) {
  const auto pixels = static_cast<unsigned long long>(plan.width()) * plan.height();
  if (error.share() >= 1) return formatted("on all %llu pixels", pixels);
  return formatted("on %u of %llu pixels", error.pixels(), pixels) +
         (error.share() > 0 ? " drawn at random" : "");
}

/// "; 99.4 % of all are within that, with 95 % confidence": rounded down.
std::string bounded(const v1::ColorError& error) {
  if (!(error.share() > 0 && error.share() < 1)) return "";
  return formatted(", as are %.1f %% of all with 95 %% confidence",
                   std::floor(1000 * error.share()) / 10);
}

std::string seen_by(const v1::Accuracy& accuracy) {
  if (accuracy.white_size() != 3) return "";
  const auto* cie = v1::Observer_descriptor()->FindValueByNumber(accuracy.observer());
  const std::string observer = !accuracy.observer_file().empty() ? quoted(accuracy.observer_file())
                               : cie != nullptr                  ? word_of(*cie)
                                                                 : std::string();
  return " (" + (observer.empty() ? observer : observer + ", ") +
         formatted("white X %.4g Y %.4g Z %.4g)", accuracy.white(0), accuracy.white(1),
                   accuracy.white(2));
}

}  // namespace

std::string noise_text(const v1::ColorError& noise) {
  return formatted(
      "noise of its samples: ΔE00 mean %.3g, 95 %% below %.3g, at most %.3g of %u pixels",
      noise.mean(), noise.percentile_95(), noise.maximum(), noise.pixels());
}

std::optional<PromiseText> promise_text(const v1::Plan& plan, const v1::Finished& finished) {
  if (!finished.has_accuracy()) return std::nullopt;
  const v1::Goal& goal = plan.auto_();
  const v1::ColorError& error = finished.accuracy().error();

  std::string text = method_text(plan.method()) + ": ΔE00 against the reference, ";
  text += looked_at(plan, error);
  text += formatted(": mean %.3g, 95 %% below %.3g, at most %.3g", error.mean(),
                    error.percentile_95(), error.maximum());
  text += bounded(error) + seen_by(finished.accuracy());
  if (finished.accuracy().has_noise()) text += "; " + noise_text(finished.accuracy().noise());
  if (goal.has_deadline())
    text += formatted("; it took %.3g s, and %.3g s were asked for", finished.timing().total(),
                      goal.deadline());
  if (goal.has_tolerance()) text += formatted("; at most %.3g was asked for", goal.tolerance());
  return PromiseText{.kept = !plan.has_auto_() || finished.accuracy().kept(),
                     .text = std::move(text)};
}

}  // namespace metamer::client
