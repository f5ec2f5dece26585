#pragma once

#include <cstdint>
#include <vector>

#include "common/scene/fresnel_table.h"
#include "common/spectral/spectrum.h"

/// A rough surface's lobe (shaders/models/he_torrance.glsl) depends on wavelength by its Fresnel
/// term F(cosine; λ) and by its geometry, which is another function of λ for each pair of
/// directions. That function is smooth, q² Σ … e^(−c/λ²) (ripples.glsl): known at eight
/// wavelengths, it is a polynomial through them, and what a ray meets is eight weights. So no ray
/// carries a spectrum.
///
///     lobe(λ) = Σ_w weight_w · window_w(λ) F(cosine; λ),   weight_w = the geometry at λ_w
///
/// The windows sum to 1, and are below 0 here and there, as weights of a sum may be.
///
/// Eight are the fewest with which X Y Z are right to 3e-4 of themselves for all roughnesses,
/// correlation lengths and directions where there is light to be seen (measured against a sum over
/// every nm: 7 wavelengths 2e-3, 10 of them 2.5e-4, as then what is beyond 390 to 730 nm, where end
/// values hold, is all of the error). Hat functions between eight, which are nowhere below 0, are
/// off by 5e-2; nodes in 1/λ or 1/λ² crowd where blue is and miss the red by 10 times as much.
namespace metamer {

inline constexpr std::uint32_t lobe_wavelengths = 8;
/// Chebyshev's nodes of 390 to 730 nm, rising.
double lobe_nm(std::uint32_t wavelength);
/// The polynomial that is 1 at its own node and 0 at the others; end values hold outside.
double lobe_window(std::uint32_t wavelength, double nm);

/// The Fresnel term is on a line between nodes of its cosine, as in fresnel_table.h but fewer, for
/// there is a row a wavelength: within 3e-4.
inline constexpr std::uint32_t lobe_cosines = 128;
FresnelPlace lobe_place(float cosine);

/// A grid between whose samples a window is a line, to 1e-3.
const Spectrum& lobe_grid();

/// The rows of a material, at some wavelengths: node = lobe_wavelengths · cosine's + wavelength's.
class RoughLobeTable {
 public:
  /// `constants`: null where Schlick's approximation is, of `specular` at normal incidence.
  RoughLobeTable(const OpticalConstants* constants, const Spectrum& specular,
                 const std::vector<double>& nm);
  std::vector<double> values(std::uint32_t node) const;

 private:
  bool is_exact_;
  ConstantsAt constants_;
  std::vector<double> specular_;
  std::vector<std::vector<double>> windows_;
};

}  // namespace metamer
