#include "common/image/compare.h"

#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "common/color/lab.h"

namespace metamer {
namespace {

double difference(const Xyz& a, const Xyz& b, Metric metric, const Xyz& white) {
  for (std::size_t c = 0; c < 3; ++c)
    if (!std::isfinite(a[c]) || !std::isfinite(b[c]))
      return std::numeric_limits<double>::quiet_NaN();
  switch (metric) {
    case Metric::de00:
      return delta_e_00(to_lab(a, white), to_lab(b, white));
    case Metric::deuv:
      return delta_e_uv(to_luv(a, white), to_luv(b, white));
    case Metric::deab:
      return delta_e_ab(to_lab(a, white), to_lab(b, white));
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string size_text(const Image& image) {
  return std::to_string(image.width) + " × " + std::to_string(image.height);
}

}  // namespace

const char* name_of(Metric metric) {
  switch (metric) {
    case Metric::de00:
      return "ΔE00";
    case Metric::deuv:
      return "ΔE*uv";
    case Metric::deab:
      return "ΔE*ab";
  }
  return "";
}

Result<Difference> compare(const Image& a, const Image& b, Metric metric, const Xyz& white) {
  assert(a.channels.size() == 3 && b.channels.size() == 3);
  if (a.width != b.width || a.height != b.height)
    return problem("the pictures differ in size: " + size_text(a) + " and " + size_text(b) +
                   " pixels");
  Difference result;
  result.width = a.width;
  result.height = a.height;
  result.values.resize(a.pixels.size() / 3);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const float *one = a.pixels.data() + 3 * i, *other = b.pixels.data() + 3 * i;
    result.values[i] =
        difference({one[0], one[1], one[2]}, {other[0], other[1], other[2]}, metric, white);
  }
  result.statistics = error_statistics(result.values);
  return result;
}

}  // namespace metamer
