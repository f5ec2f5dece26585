#pragma once

#include <optional>
#include <string>

#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::client {

/// What was measured of a picture, beside what was promised.
struct PromiseText {
  bool kept = true;  ///< Also where nothing was promised.
  /// "exact: ΔE00 against the reference, on 512 of 307200 pixels drawn at random: mean …, at most
  /// …, as are 99.4 % of all with 95 % confidence (cie-1931-2deg, white …); at most 0.5 was asked
  /// for"
  std::string text;
};

/// "noise of its samples: ΔE00 mean 0.2, 95 % below 0.5, at most 0.9 of 512 pixels"
std::string noise_text(const v1::ColorError& noise);

/// Nothing where nothing was measured.
std::optional<PromiseText> promise_text(const v1::Plan& plan, const v1::Finished& finished);

}  // namespace metamer::client
