#pragma once

#include <string>
#include <vector>

#include "client/tools/pictures/save_pictures.h"

namespace metamer::client {

/// What is to be said of a file that was written, a sentence each: what a .png had to clip, and
/// what a spectral one does not have in common with the others.
std::vector<std::string> saved_notes(const SavedPicture& saved, const v1::Plan& plan,
                                     const PlannedDeveloping& planned);

}  // namespace metamer::client
