#include "client/tools/spectra/metamer_table.h"

#include <utility>

namespace metamer::client {

Result<MetamerTable> metamer_table(const Spectrum& original, const NamedSpectrum& under,
                                   const NamedSpectrum& against, const Observer& observer) {
  auto made = make_metamer(original, under.spectrum, against.spectrum, observer);
  if (!made) return tl::unexpected(std::move(made.error()));
  std::vector<NamedSpectrum> lights = cie_lights();
  for (const NamedSpectrum* light : {&under, &against})
    if (cie::illuminant(light->name) == nullptr) lights.push_back(*light);
  return metamerism(original, made->reflectance, lights, observer)
      .map([&](std::vector<Mismatch>&& differences) {
        return MetamerTable{std::move(made->reflectance), std::move(differences)};
      });
}

std::string usual_other_light(const std::string& under) { return under == "A" ? "D65" : "A"; }

}  // namespace metamer::client
