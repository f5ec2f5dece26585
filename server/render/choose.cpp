#include "server/render/choose.h"

#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>

namespace metamer {
namespace {

/// Fresh pixels show a little more than the pilot's worst.
constexpr double tolerance_margin = 0.8;
/// A prediction is made on a machine that does other things as well.
constexpr double deadline_margin = 0.8;
/// Costs that differ by no more are the same.
constexpr double noise = 0.05;
/// A look at one more method may cost this share of the picture.
constexpr double worth_a_look = 0.01;
/// ΔE00 that nobody sees: it is not worth any time to be better.
constexpr double invisible = 0.05;

using Fits = std::function<bool(const Predicted&)>;

Predicted* most_accurate(std::vector<Predicted>& all, const Fits& fits) {
  Predicted* best = nullptr;
  for (Predicted& one : all)
    if (!one.rejected && fits(one) && (!best || one.error() < best->error())) best = &one;
  return best;
}

using Price = double (*)(const Predicted&);
double counted(const Predicted& one) { return one.cost; }
double measured(const Predicted& one) { return one.seconds(); }

/// Of those that cost about the same, the most accurate one.
Predicted* cheapest(std::vector<Predicted>& all, const Fits& fits, Price price) {
  double least = std::numeric_limits<double>::infinity();
  for (const Predicted& one : all)
    if (!one.rejected && fits(one)) least = std::min(least, price(one));
  return most_accurate(
      all, [&](const Predicted& one) { return fits(one) && price(one) <= (1 + noise) * least; });
}

Choice conclude(std::vector<Predicted>& all, Predicted* best, std::string objection) {
  Choice choice;
  choice.objection = std::move(objection);
  best->prediction.set_chosen(true);
  choice.method = best->prediction.method();
  choice.prepared = std::move(best->method);
  std::sort(all.begin(), all.end(),
            [](const Predicted& a, const Predicted& b) { return a.seconds() < b.seconds(); });
  for (const Predicted& one : all) choice.predictions.push_back(one.prediction);
  return choice;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// Noise that is more than what was asked for, which no method changes; empty: it is not.
std::string noisy(const Predictor& predictor, double tolerance) {
  if (!predictor.noise() || predictor.noise()->percentile_95() <= tolerance) return {};
  return "the noise of its samples is ΔE00 " + number(predictor.noise()->percentile_95()) +
         " at 95 % of the pixels, more than the tolerance of " + number(tolerance) +
         ": that takes more spp, light_samples or bounce_samples";
}

Choice keep_tolerance(Predictor& predictor, const std::atomic<bool>& stopped, double tolerance) {
  const Fits fits = [&](const Predicted& one) {
    return one.error() <= tolerance_margin * tolerance;
  };
  const Fits may_fit = [&](const Predicted& one) {
    return one.prediction.error().maximum() <= tolerance;
  };
  std::vector<Predicted> all;
  const std::vector<v1::Method> methods = candidates();
  for (std::uint32_t round = 0;; ++round) {
    // Look on while nothing fits, or while that costs next to nothing and could save more.
    Predicted* best = cheapest(all, fits, counted);
    while (all.empty() || (all.size() < methods.size() && !stopped &&
                           (!best || (all.back().look < worth_a_look * best->cost &&
                                      best->cost - predictor.trace_cost() > all.back().look)))) {
      all.push_back(predictor.predict(methods[all.size()]));
      best = cheapest(all, fits, counted);
    }

    // Nothing fits with a margin: the best of those that the pilot's pixels do not speak against.
    if (!best) best = most_accurate(all, may_fit);
    if (!best) {
      best = &*std::min_element(all.begin(), all.end(), [](const Predicted& a, const Predicted& b) {
        return a.error() < b.error();
      });
      return conclude(all, best,
                      "no method keeps to a tolerance of " + number(tolerance) +
                          "; the best one is off by " + number(best->error()));
    }

    // Ask pixels that had no part in this.
    const v1::ColorError fresh = predictor.check(*best->method, round);
    if (fresh.maximum() <= tolerance || stopped)
      return conclude(all, best, noisy(predictor, tolerance));
    best->rejected = true;
  }
}

Choice keep_deadline(Predictor& predictor, const std::atomic<bool>& stopped, double deadline,
                     const std::function<double()>& elapsed) {
  std::vector<Predicted> all;
  const Fits fits = [&](const Predicted& one) {
    return elapsed() + one.seconds() <= deadline_margin * deadline;
  };
  Predicted* best = nullptr;
  double looking = 0;
  for (const v1::Method& method : candidates()) {
    if ((stopped && !all.empty()) ||
        (best && (best->error() <= invisible || looking > 0.1 * deadline)))
      break;
    all.push_back(predictor.predict(method));
    looking += all.back().took;
    best = most_accurate(all, fits);
  }
  if (best) return conclude(all, best, {});
  best = cheapest(
      all, [](const Predicted&) { return true; }, measured);
  return conclude(all, best,
                  "no method keeps to a deadline of " + number(deadline) +
                      " s; the cheapest one takes about " + number(elapsed() + best->seconds()) +
                      " s");
}

}  // namespace

Choice choose(const PilotScene& pilot, const v1::Goal& goal, double elapsed) {
  const auto start = std::chrono::steady_clock::now();
  const auto so_far = [=] {
    return elapsed +
           std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  Predictor predictor(pilot);
  return goal.has_deadline() ? keep_deadline(predictor, pilot.stopped, goal.deadline(), so_far)
                             : keep_tolerance(predictor, pilot.stopped, goal.tolerance());
}

std::vector<v1::Prediction> predict_all(const PilotScene& pilot, const v1::Method& method) {
  using google::protobuf::util::MessageDifferencer;
  Predictor predictor(pilot);
  std::vector<v1::Method> methods = candidates();
  const auto same = [&](const v1::Method& other) {
    return MessageDifferencer::Equals(method, other);
  };
  if (std::none_of(methods.begin(), methods.end(), same)) methods.push_back(method);
  std::vector<v1::Prediction> all;
  for (const v1::Method& one : methods) {
    if (pilot.stopped) break;
    all.push_back(predictor.predict(one).prediction);
    all.back().set_chosen(same(one));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.prepare() + a.render() < b.prepare() + b.render();
  });
  return all;
}

}  // namespace metamer
