#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "client/cli/report.h"
#include "client/relight/factors.h"
#include "client/tools/spectra/spectra_files.h"

/// What relight gives to lights and materials, picture by picture.
namespace metamer::cli {

/// NAME=SPECTRUM, of a name that is known; names may have "=" in them, and so may files.
struct Swap {
  std::string name, spectrum;
};

/// What one of several pictures is lit by, or painted with.
struct Variant {
  std::string label;        ///< For people: its spectra, "lamps warm+F11", "D65, lamp=A"; "kept".
  std::vector<Swap> swaps;  ///< One for each name.
};

/// Options of one kind as variants, at least one: the i-th spectrum that is given to a name is that
/// of the i-th variant, and what is given once is that of all. Reports what is wrong: a name that
/// is none of `names`, names that are given several spectra, but not as many, lights that a later
/// name takes all of.
std::optional<std::vector<Variant>> variants_of(const std::string& option, const std::string& what,
                                                const std::vector<std::string>& texts,
                                                const std::vector<std::string>& names,
                                                Report& report);

/// Gives the scenes of factors what variants say; reads each file once.
class Swapper {
 public:
  Swapper(const client::Factors& factors, Report& report) : factors_(factors), report_(report) {}

  /// False: a spectrum is none for that, which is said.
  bool swap_lights(const Variant& variant, v1::SceneFactors& scene);
  bool swap_materials(const Variant& variant, v1::SceneFactors& scene);

 private:
  /// Null: it can't be read, or is no such spectrum; said once, as is what the scene's observer
  /// misses of it.
  const Spectrum* load(Use use, const std::string& word, const v1::SceneFactors& scene);
  void tell_unseen(Use use, const std::string& word, const Spectrum& spectrum,
                   const v1::SceneFactors& scene);

  const client::Factors& factors_;
  Report& report_;
  std::map<std::pair<Use, std::string>, std::optional<Spectrum>> loaded_;
  std::set<std::string> told_;  ///< Of materials that no pixel shows.
};

/// In place of a spectrum: the one that the picture was rendered with.
inline constexpr const char* kept_word = "kept";

}  // namespace metamer::cli
