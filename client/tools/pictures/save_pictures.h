#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "client/relight/factors.h"
#include "client/tools/pictures/planned_developing.h"
#include "common/image/image.h"
#include "common/spectral/wavelengths.h"

/// A finished picture into files.
namespace metamer::client {

/// A picture and all that its files are made of.
struct Pictures {
  const Image& xyz;
  const v1::Plan& plan;                         ///< Its observer, development and source white.
  const Factors* factors;                       ///< For spectra; null where they are not at hand:
                                                ///< no spectral file can be written then.
  const v1::SceneFactors* scene;                ///< The spectra that the factors are multiplied by.
  std::map<std::string, std::string> metadata;  ///< Beside version and plan.
};

/// What an .exr holds: linear RGB, X Y Z, or a spectrum in each pixel.
struct ExrContent {
  bool xyz = false;
  std::optional<Wavelengths> spectral = {};
};

/// ".png", in whatever case it was written.
std::string lower_extension(const std::string& file);
bool is_exr(const std::string& file);

/// Why a file can't be written; empty: nothing speaks against it. Factors go into a .factors, a
/// picture into a .png or an .exr.
enum class FileContent { picture, factors };
std::string objection(const std::string& file, FileContent content);

/// How much of a light's luminance the wavelengths of a spectral picture see; 1: all of it.
struct SeenLight {
  std::string light;
  double share;
};

/// What is to be said of a file that was written.
struct SavedPicture {
  GamutReport clipped;              ///< Of a .png.
  bool spectral = false;            ///< It has a spectrum in each pixel, by the method `exact`.
  std::vector<SeenLight> mis_seen;  ///< Of that: lights of which more or less than 0.98 to 1.02.
};

/// Writes a picture into one file, by its extension, with version and plan as metadata. `planned`
/// is the plan's. Errors name the file: those of write_image and write_spectral_exr, and a
/// spectral picture of more than max_image_values values. A spectral file needs the factors.
Result<SavedPicture> save_picture(const Pictures& pictures, const std::string& file,
                                  const ExrContent& exr, const PlannedDeveloping& planned);

/// Files that one picture is to be written into.
struct PictureFiles {
  Pictures pictures;
  std::vector<std::string> files;
  PlannedDeveloping planned = {};
};

/// The same of several pictures, side by side on all threads; what became of each file, by picture.
/// Spectral files, which may take 1 GiB each, come one after the other.
std::vector<std::vector<Result<SavedPicture>>> save_all(const std::vector<PictureFiles>& all,
                                                        const ExrContent& exr);

}  // namespace metamer::client
