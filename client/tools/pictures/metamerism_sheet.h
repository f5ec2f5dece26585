#pragma once

#include <vector>

#include "client/relight/factors.h"
#include "client/tools/pictures/contact_sheet.h"
#include "client/tools/spectra/paint_match.h"

/// Paints in a kept picture under several lights, side by side.
namespace metamer::client {

struct SheetQuestion {
  std::vector<NamedSpectrum> lights;  ///< At least one; the first is the reference.
  std::vector<NamedSpectrum> paints;  ///< At least two; the first is the reference.
  /// Whose diffuse reflectance each paint becomes, by their places in the scene's list.
  std::vector<int> materials;
};

struct MetamerismSheet {
  Sheet sheet;  ///< A row for each paint, with maps, and what R, G and B make of the first.
  Developing developing;            ///< Of its picture (contact_sheet), as write_image takes it.
  std::vector<PaintMatch> matches;  ///< Of the paints but the first, as spectra.
};

/// All lights of the scene get the power of one after the other. `plan` and `scene` are of the
/// picture as it is seen: its observer and development. Errors: those of match_paints; a material
/// that is not there.
Result<MetamerismSheet> metamerism_sheet(const Factors& factors, const v1::SceneFactors& scene,
                                         const v1::Plan& plan, const SheetQuestion& question);

}  // namespace metamer::client
