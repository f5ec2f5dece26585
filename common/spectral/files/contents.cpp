#include "common/spectral/files/contents.h"

#include "common/spectral/wavelengths.h"

namespace metamer::spectrum_text {

std::optional<std::string> wrong_next(const std::vector<double>& before, double next) {
  if (before.empty()) return wrong_positions({next});
  const bool falls = before.size() == 1 ? next < before.front() : before[1] < before[0];
  if (!falls) return wrong_positions({before.back(), next});
  if (next > before.back())
    return "wavelengths must go on falling: " + number_text(next) + " follows " +
           number_text(before.back());
  return wrong_positions(next == before.back() ? std::vector{next, next} : std::vector{next});
}

}  // namespace metamer::spectrum_text
