#pragma once

#include <array>
#include <vector>

#include "common/spectral/spectrum.h"
#include "server/scene/environment/sky_picture.h"

namespace metamer {

/// The sky by day after A. J. Preetham, P. Shirley and B. Smits, "A Practical Analytic Model for
/// Daylight" (SIGGRAPH 1999), A.2, without the sun itself.
class DaylightSky {
 public:
  /// Within the ranges of common/color/sunlight.h; the sun's elevation in degrees.
  DaylightSky(double turbidity, double elevation);

  struct Colour {
    double x, y;       ///< Of the 1931 observer.
    double luminance;  ///< kcd/m²
  };
  /// By the cosine (above 0) of the angle to the zenith, and that of the angle to the sun.
  Colour at(double zenith_cosine, double sun_cosine) const;

  double sun_zenith() const { return sun_zenith_; }  ///< Of the sun, radians.

 private:
  /// R. Perez, R. Seals and J. Michalsky (1993), by A to E; of x, y and the luminance.
  struct Perez {
    std::array<double, 5> a;
    double value(double zenith_cosine, double sun_angle, double sun_cosine) const;
    double zenith = 1;  ///< What it is there, by value() there.
  };
  double sun_zenith_;
  Perez x_, y_, luminance_;
};

/// A sky as a picture of three spectra that are nowhere below 0, whatever of it is blue or white.
struct PaintedSky {
  SkyPicture picture;
  std::vector<Spectrum> parts;  ///< What its values weigh.
  Spectrum whole;               ///< What lights the ground.
};

/// The sun stands over −z. Below the horizon it is black. Where the model asks for light that is
/// below 0 at some wavelengths, as it does about a low sun, that is 0.
PaintedSky paint(const DaylightSky& sky);

}  // namespace metamer
