#pragma once

#include "common/color/seen_light.h"
#include "common/spectral/panels.h"

/// Where products of spectra have to be known, so that what is seen of them is right to some 1e-6
/// of itself. Not at every nanometre: seldom where nothing bends, or little is seen of any light.
namespace metamer {

/// Panels in which products of up to `times` of `curves`, each as often as one likes, are
/// polynomials. Right for the X (`axis` 0), Y or Z of each of `lights`, relative to that of the
/// product itself and its Y. Curves are not below 0 and keep their end values outside. Of `once` a
/// product holds one, by itself.
Panels chain_panels(const std::vector<const Spectrum*>& curves, unsigned times,
                    const std::vector<SeenLight>& lights, std::size_t axis,
                    const std::vector<const Spectrum*>& once = {});

/// Edges between which each of `spectra` is a line.
std::vector<double> bend_edges(const std::vector<const Spectrum*>& spectra,
                               const std::vector<SeenLight>& lights);

/// Samples that say what a function of `spectra` is that is no line between theirs: by half
/// nanometres, and wherever one of them has a sample.
std::vector<double> dense_nm(const std::vector<const Spectrum*>& spectra);

}  // namespace metamer
