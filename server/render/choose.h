#pragma once

#include "common/scene/methods.h"
#include "server/render/predict.h"

namespace metamer {

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
/// more than it takes. A tolerance is kept by counted costs (Method::resolve_cost), so the choice
/// is the same on every machine at any load; a deadline by measured ones.
Choice choose(const PilotScene& pilot, const v1::Goal& goal, double elapsed);

/// The predictions of all candidates(), for those who want to know; `method` among them, marked as
/// chosen.
std::vector<v1::Prediction> predict_all(const PilotScene& pilot, const v1::Method& method);

}  // namespace metamer
