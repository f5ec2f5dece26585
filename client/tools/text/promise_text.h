#pragma once

#include <optional>
#include <string>

#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::client {

/// What a chosen method promised, beside what was measured of the picture.
struct PromiseText {
  bool kept = true;
  /// "exact: ΔE00 against the reference, on 500 pixels …: mean …; at most 0.5 was asked for"
  std::string text;
};

/// Nothing where no promise was asked for, or none measured.
std::optional<PromiseText> promise_text(const v1::Plan& plan, const v1::Finished& finished);

}  // namespace metamer::client
