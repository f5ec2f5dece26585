#pragma once

#include "server/render/predict.h"

namespace metamer {

/// Every method with the parameters that are worth their price: the exact one first, as it is
/// mostly among the cheapest too, then the cheapest first as far as that can be told beforehand.
/// What they cost in a scene is measured.
std::vector<v1::Method> candidates();

/// The method that a job is rendered with, and why.
struct Choice {
  v1::Method method;
  std::unique_ptr<Method> prepared;         ///< Its tables; null where it was not predicted.
  std::vector<v1::Prediction> predictions;  ///< The cheapest first.
  std::string objection;  ///< Why the promise will not be kept; empty: nothing speaks against it.
};

/// With a tolerance, the cheapest method that keeps to it: on the pilot's pixels, among the scene's
/// colours, and on pixels that had no part in the choice. With a deadline, the most accurate one
/// that keeps to it, where `elapsed` seconds are spent already. Looks on only while that can save
/// more time than it takes.
Choice choose(const PilotScene& pilot, const v1::Auto& goal, double elapsed);

/// All the candidates' predictions, for those who want to know; `method` among them, marked as
/// chosen.
std::vector<v1::Prediction> predict_all(const PilotScene& pilot, const v1::Method& method);

}  // namespace metamer
