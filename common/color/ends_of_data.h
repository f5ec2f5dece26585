#pragma once

#include <string>
#include <vector>

#include "common/spectral/observer.h"

/// What is to be said where a spectrum has no data and yet is used: sentences, empty where that
/// changes nothing that people notice.
namespace metamer {

/// How much of a light is seen up to a wavelength: X + Y + Z.
class CumulativeLight {
 public:
  CumulativeLight(std::string name, const Spectrum& emission, const Observer& observer);

  const std::string& name() const { return name_; }
  bool any() const { return below_.back() > 0; }
  /// Of any().
  double share_outside(double from, double to) const;

 private:
  double below(double nm) const;

  std::string name_;
  std::vector<double> nm_, below_;
};

/// Of a light, which is 0 beyond its data: its white would be ΔE00 0.3 or more another if it went
/// on as it ends. A single sample is a line, which has no ends.
std::string ends_of_light(const Spectrum& emission, const Observer& observer);

/// Of a property, which keeps its end values: more than 1 % of what is seen of one of the lights
/// lies beyond its data.
std::string ends_of_property(const Spectrum& property, const std::vector<CumulativeLight>& lights);

/// Of an observer, who sees nothing beyond his data: one of his functions ends above 2 % of its
/// largest value. What lies outside 360 to 830 nm is Observer::is_cut's to say.
std::string ends_of_observer(const Observer& observer);

}  // namespace metamer
