#pragma once

#include <algorithm>
#include <cmath>

#include "common/scene/limits.h"
#include "metamer/v1/views.pb.h"

namespace metamer {

/// Of a v1::Probed's spectra: every whole nm from 360 to 830.
inline constexpr int probed_first_nm = 360, probed_last_nm = 830;
inline constexpr int probed_values = probed_last_nm - probed_first_nm + 1;
/// The side of the square that X Y Z are a mean of, in pixels; more are a picture.
inline constexpr std::uint32_t max_probe_side = 64;
/// Of a view, waiting for their turn; of more the oldest give way. As many as pins that anybody
/// looks at together.
inline constexpr std::size_t max_probes = 8;

/// Whether it can be what a view shows: X Y Z or none; an object with its material and all three
/// spectra, or nothing of them; finite numbers.
inline bool is_sound(const v1::Probed& probed) {
  const bool met = !probed.object().empty();
  const int values = met ? probed_values : 0;
  const auto finite = [](const google::protobuf::RepeatedField<double>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [](double value) { return std::isfinite(value); });
  };
  const auto whole = [&](const google::protobuf::RepeatedField<double>& spectrum) {
    return spectrum.size() == values && finite(spectrum);
  };
  const auto somewhere = [](const v1::Vec3& v) {
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
  };
  // A name of so many characters of UTF-8, or a field's path.
  constexpr std::size_t longest = 4 * limits::max_name;
  return (probed.xyz().empty() || probed.xyz_size() == 3) && finite(probed.xyz()) &&
         whole(probed.eye()) && whole(probed.light()) && whole(probed.surface()) &&
         probed.material().empty() != met && probed.has_place() == met &&
         probed.has_normal() == met && somewhere(probed.place()) && somewhere(probed.normal()) &&
         probed.object().size() <= longest && probed.material().size() <= longest;
}

}  // namespace metamer
