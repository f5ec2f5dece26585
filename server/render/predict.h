#pragma once

#include <memory>
#include <optional>

#include "server/plan/plan.h"
#include "server/render/pilot.h"

namespace metamer {

/// What is predicted: a scene in front of its camera, by one backend.
struct PilotScene {
  const RenderScene& scene;
  Probe& probe;                  ///< Of that scene; prepared.
  const v1::Settings& settings;  ///< Validated, defaults filled in; the method does not matter.
  const Capabilities& capabilities;
  const std::atomic<bool>& stopped;
  std::atomic<std::uint64_t>& work;
};

/// A prediction and what was made for it.
struct Predicted {
  v1::Prediction prediction;
  std::unique_ptr<Method> method;
  double took = 0;        ///< Seconds that the prediction cost.
  double cost = 0;        ///< Of the whole picture, counted: ns of one core (Method::resolve_cost).
  double look = 0;        ///< What the prediction cost, counted likewise.
  bool rejected = false;  ///< Fresh pixels showed more than the pilot did.

  double seconds() const { return prediction.prepare() + prediction.render(); }
  /// The largest ΔE00 seen, in the picture or among the scene's colours.
  double error() const { return std::max(prediction.error().maximum(), prediction.bound()); }
};

/// Predicts what methods would cost and how far off they would be, from pixels that are traced
/// once. Belongs to one thread; what it refers to must outlive it.
class Predictor {
 public:
  explicit Predictor(const PilotScene& pilot);

  Predicted predict(const v1::Method& method);

  /// The error on pixels that had no part in predictions; another `round`, other pixels.
  v1::ColorError check(const Method& method, std::uint32_t round);

  /// That of the picture's samples, whatever the method; nothing: nothing is sampled.
  const std::optional<v1::ColorError>& noise() const { return noise_; }

  /// The counted cost of the picture's rays, which any method has.
  double trace_cost() const { return trace_cost_; }

 private:
  const PilotScene& pilot_;
  v1::Plan plan_;
  Reference reference_;
  PilotPixels pixels_, colors_;
  std::optional<v1::ColorError> noise_;
  double trace_cost_;
};

/// A plan's promise after its picture was rendered: the error on pixels drawn at random, which had
/// no part in the choice. What the largest of them says of all
/// is bounded_share; those that share a packet with them are looked at too, and make it only safer.
v1::Accuracy measure(const PilotScene& pilot, const Method& method);

/// An error with what it is seen by.
v1::Accuracy accuracy_of(const v1::ColorError& error, const v1::Plan& plan, const Xyz& white);

/// What a pixel costs on average, in the counted ns of Method::resolve_cost: its rays, and what a
/// method makes of them.
double counted_pixel_cost(const Method& method, const TracedPixels& pixels);

/// The plan of the pilot's scene with another method.
v1::Plan plan_with(const PilotScene& pilot, const v1::Method& method);

}  // namespace metamer
