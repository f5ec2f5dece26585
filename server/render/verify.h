#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "common/color/lab.h"
#include "server/plan/reference_method.h"
#include "server/render/predict.h"
#include "server/render/renderer.h"

namespace metamer {

/// The check of a finished picture, pixel by pixel, against the one that the reference makes of the
/// same scene: a renderer changes to plan() and method(), and draws picture().
class Verification {
 public:
  /// All must outlive it; nothing writes into `film` meanwhile.
  Verification(const RenderScene& scene, const v1::Plan& plan, const Film& film);

  const v1::Plan& plan() const { return plan_; }
  const Method& method() const { return method_; }
  /// In the tiles of the plan. `compared` is told from any thread how many of them are done, each
  /// number once, in any order.
  Picture picture(std::function<void(std::uint32_t tiles)> compared);
  std::uint32_t tiles() const { return static_cast<std::uint32_t>(tiles_.size()); }

  /// What came of all pixels, once the picture is drawn.
  v1::Accuracy accuracy() const;

 private:
  void compare(const Rect& tile);

  v1::Plan plan_;
  ReferenceMethod method_;
  Xyz white_;
  Film film_;
  std::vector<Rect> tiles_;
  std::vector<float> reference_;  ///< X Y Z of each pixel.
  std::vector<double> errors_;    ///< ΔE00 of each.
  std::atomic<std::uint32_t> compared_ = 0;
};

/// The counted work of drawing the plan's picture once more, by the reference, in that of drawing
/// it by `method`: from the pilot's pixels.
double verify_cost(const PilotScene& pilot, const v1::Plan& plan, const Method& method);

}  // namespace metamer
