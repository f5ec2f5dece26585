#include "common/image/alpha.h"

#include <algorithm>
#include <cmath>

namespace metamer {

std::vector<float> take_alpha(Image& image) {
  const std::size_t channels = image.channels.size(), colors = channels - 1;
  std::vector<float> alpha(image.pixels.size() / channels);
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    const float* const pixel = image.pixels.data() + i * channels;
    alpha[i] = pixel[colors];
    std::copy_n(pixel, colors, image.pixels.data() + i * colors);
  }
  image.channels.pop_back();
  image.pixels.resize(alpha.size() * colors);
  return alpha;
}

std::string alpha_text(const std::vector<float>& alpha) {
  if (std::all_of(alpha.begin(), alpha.end(), [](float value) { return value == 1; }))
    return "its alpha is 1 everywhere";
  const auto [least, most] = std::minmax_element(alpha.begin(), alpha.end());
  const auto rounded = [](double value) { return number_text(std::round(value * 1000) / 1000); };
  return "its alpha goes from " + rounded(*least) + " to " + rounded(*most) +
         ": it is compared as over black";
}

}  // namespace metamer
