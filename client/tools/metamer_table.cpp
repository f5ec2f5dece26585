#include "client/tools/metamer_table.h"

#include <utility>

namespace metamer::client {

Result<MetamerTable> metamer_table(const Spectrum& original, const NamedSpectrum& under,
                                   const NamedSpectrum& against, cie::Observer observer) {
  auto made = make_metamer(original, under.spectrum, against.spectrum, observer);
  if (!made) return tl::unexpected(std::move(made.error()));
  MetamerTable table{std::move(made->reflectance), {}};
  std::vector<NamedSpectrum> lights = cie_lights();
  for (const NamedSpectrum* light : {&under, &against})
    if (cie::illuminant(light->name) == nullptr) lights.push_back(*light);
  if (auto differences = metamerism(original, table.reflectance, lights, observer))
    table.differences = std::move(*differences);
  return table;
}

std::string usual_other_light(const std::string& under) { return under == "A" ? "D65" : "A"; }

}  // namespace metamer::client
