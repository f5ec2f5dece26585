#include "common/color/usable_white.h"

#include <algorithm>

namespace metamer {

Xyz usable_white(const Xyz& white) {
  const auto [least, most] = std::minmax_element(white.begin(), white.end());
  return *least > 1e-6 * *most ? white : Xyz{1, 1, 1};
}

}  // namespace metamer
