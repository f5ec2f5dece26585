#pragma once

#include <map>
#include <optional>
#include <string>

#include "client/cli/exit_code.h"
#include "client/cli/options.h"
#include "client/cli/report.h"
#include "client/relight/factors.h"
#include "common/image/image.h"
#include "common/spectral/wavelengths.h"

namespace metamer::cli {

/// A picture and all that its files are made of.
struct Pictures {
  const Image& xyz;
  const v1::Plan& plan;                         ///< Its observer, development and source white.
  const Factors* factors;                       ///< For spectra; null where they are not at hand:
                                                ///< no spectral file is written then.
  const v1::SceneFactors* scene;                ///< The spectra that the factors are multiplied by.
  std::map<std::string, std::string> metadata;  ///< Beside version and plan.
};

/// ".png", in whatever case it was written.
std::string lower_extension(const std::string& file);
bool is_exr(const std::string& file);

/// What --exr says: "rgb", "xyz", "spectral" or "spectral:FROM:TO:STEP".
struct ExrContent {
  bool xyz = false;
  std::optional<Wavelengths> spectral;
};
Result<ExrContent> exr_content(const OutputOptions& options);

/// Writes the picture into each of the files, and notes what a .png had to clip. Reports what went
/// wrong.
ExitCode write_pictures(const OutputOptions& options, const Pictures& pictures, Report& report);

}  // namespace metamer::cli
