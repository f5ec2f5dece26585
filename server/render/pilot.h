#pragma once

#include <atomic>
#include <vector>

#include "common/color/lab.h"
#include "metamer/v1/plan.pb.h"
#include "server/methods/method.h"
#include "server/plan/reference.h"
#include "server/render/probe.h"

namespace metamer {

/// Light that reaches pixels, and the colours that the reference makes of it. Traced once, it
/// serves to measure any method.
struct PilotPixels {
  std::vector<Gather> gathers;
  std::vector<Lab> reference;
  float scale = 1;           ///< Of the sums in a gather: 1 / samples.
  double trace_seconds = 0;  ///< A pixel, on one thread.
  double rays = 0;           ///< A pixel.
};

/// So many pixels show what a method does to a picture of this size: about one in 1024, a few
/// hundred at most, as measuring them must cost next to nothing of the picture.
std::uint32_t pilot_count(const v1::Plan& plan);

/// Traces the pixels of the run, and makes the reference's colours of them. Stops early, with what
/// it has, once `stopped`; `work` counts pixels.
PilotPixels trace_pixels(const Probe& probe, const v1::Plan& plan, PixelRun run,
                         Reference& reference, const std::atomic<bool>& stopped,
                         std::atomic<std::uint64_t>& work);

/// Made up pixels: each light on each surface that faces it, directly and in each mirror. What a
/// method gets wrong here it may get wrong where no pilot pixel fell. At most 2048.
PilotPixels scene_colors(const RenderScene& scene, Reference& reference);

/// Those from `first` up to `last`.
struct PixelRange {
  std::size_t first, last;
};

/// ΔE00 of what the method makes of each pixel of the range.
std::vector<double> color_errors(const Method& method, const PilotPixels& pixels, PixelRange range,
                                 const Xyz& white, Method::Scratch& scratch);

/// The share of all pixels that is off by no more than the largest of `count` drawn at random, each
/// by itself, with 95 % confidence: q of q^count = 0.05 (S. S. Wilks 1941, one limit).
double bounded_share(std::uint32_t count);

/// A pixel whose error is not finite makes the maximum infinite.
v1::ColorError summarize(const std::vector<double>& errors);

}  // namespace metamer
