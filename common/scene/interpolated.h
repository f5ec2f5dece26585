#pragma once

#include <optional>

#include "common/scene/validate.h"
#include "common/spectral/interpolation.h"

namespace metamer {

/// What the values of a role may be.
ValueRange value_range(SpectrumRole role);

/// Data of a role as scenes and the clients' commands read them alike: by the interpolation that is
/// asked for, else the recommended one; n, k and what gives n are straight lines unless another is
/// asked for. Curves are evaluated at the whole nanometres that are seen, 360 to 830. Error: data
/// that can't be interpolated as asked.
Result<Interpolated> interpolated(const Spectrum& samples, std::optional<Interpolation> asked,
                                  SpectrumRole role);

}  // namespace metamer
