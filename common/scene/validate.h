#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/problem.h"
#include "common/spectral/observer.h"
#include "common/spectral/wavelengths.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

/// Everything wrong with a scene that can be seen without opening a file, in the scene's order,
/// each with its field path: numbers that are not finite or out of range, names that are missing,
/// duplicate or unknown (with "did you mean"), sizes over the limits, wavelengths unsorted or
/// repeated, degenerate cameras, shapes and transforms, parameters of models against models.def.
/// Both sides run it: the client before it sends, the worker because clients may lie. Empty: the
/// scene is sound.
std::vector<Problem> validate_scene(const v1::Scene& scene);

/// The bytes of a file that the scene names, by its name as written there.
using AssetReader = std::function<Result<std::string>(const std::string& name)>;

/// The spectrum that a message stands for. Errors carry the field path below `field`, or file,
/// line and column inside an asset. Its values must lie in the range of its role. Data are
/// interpolated (interpolated.h) and have their lines: straight lines between samples are all of
/// it.
enum class SpectrumRole {
  emission,     ///< Not negative, not 0 everywhere.
  property,     ///< 0..1
  reflectance,  ///< 0..0.999999: an index of refraction is computed of it, E[2.2-11].
  index,        ///< n, 0.01..100
  extinction,   ///< k, 0..100
  excitation,   ///< The share that is absorbed to be re-radiated, 0..1; 0 outside its data.
};
Result<Spectrum> load_spectrum(const v1::Spectrum& message, const std::string& field,
                               SpectrumRole role, const AssetReader& assets);

/// The same with what its file was taken for where nobody says it: a sentence each.
struct NotedSpectrum {
  Spectrum spectrum;
  std::vector<std::string> notes = {};
};
Result<NotedSpectrum> load_noted_spectrum(const v1::Spectrum& message, const std::string& field,
                                          SpectrumRole role, const AssetReader& assets);

/// The observer that settings stand for, `field` being theirs: one of the CIE's, or that of
/// observer_file (parse_observer), which is the asset's name.
Result<Observer> load_observer(const v1::Settings& settings, const std::string& field,
                               const AssetReader& assets);

/// Every spectrum and observer of the scene, and of its looks, loaded and checked, all problems
/// found. For the client's early check.
std::vector<Problem> validate_spectra(const v1::Scene& scene, const AssetReader& assets);

}  // namespace metamer
