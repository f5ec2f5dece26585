#include "client/tools/pictures/pixel_spectrum.h"

#include <map>

#include "client/relight/relight.h"
#include "client/tools/pictures/pixel_reading.h"

namespace metamer::client {

std::vector<double> pixel_spectrum(const Factors& factors, const v1::SceneFactors& scene,
                                   const Observer& observer, int x, int y, int side) {
  // A picture of one pixel, whose weights are the square's means.
  const PixelSquare square =
      pixel_square(static_cast<int>(factors.width), static_cast<int>(factors.height), x, y, side);
  std::map<std::uint32_t, double> weights;
  for (int row = square.top; row <= square.bottom; ++row)
    for (int column = square.left; column <= square.right; ++column) {
      const std::size_t at =
          static_cast<std::size_t>(row) * factors.width + static_cast<std::size_t>(column);
      for (std::size_t pair = at == 0 ? 0 : factors.end[at - 1]; pair < factors.end[at]; ++pair)
        weights[factors.signature[pair]] += static_cast<double>(factors.weight[pair]);
    }
  Factors one;
  one.tables = factors.tables;
  one.width = one.height = 1;
  for (const auto& [signature, weight] : weights) {
    one.signature.push_back(signature);
    one.weight.push_back(static_cast<float>(weight / square.count()));
  }
  one.end.push_back(static_cast<std::uint32_t>(weights.size()));
  const Image seen = relight_spectral(one, scene, observer, observer_wavelengths());
  return {seen.pixels.begin(), seen.pixels.end()};
}

}  // namespace metamer::client
