#pragma once

#include <string>
#include <vector>

#include "common/image/image.h"

namespace metamer {

/// Takes the last channel out of a picture.
std::vector<float> take_alpha(Image& image);

/// What is to be said of it: that it is 1, or how far it goes and that colours count over black.
std::string alpha_text(const std::vector<float>& alpha);

}  // namespace metamer
