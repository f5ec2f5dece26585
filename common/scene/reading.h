#pragma once

#include "common/scene/validate.h"
#include "common/spectral/files/interpret.h"

namespace metamer {

/// What a message says of how a file is to be read.
Reading reading_of(const v1::Reading& message);
/// The inverse of reading_of.
v1::Reading to_message(const Reading& reading);

/// A spectrum of a file as its role needs it, with what was guessed; n and k are as they are.
/// Errors: those of interpret().
Result<Interpreted> as_role(const SpectrumFile& file, NamedSpectrum spectrum,
                            const Reading& reading, SpectrumRole role);

}  // namespace metamer
