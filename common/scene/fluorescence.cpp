#include "common/scene/fluorescence.h"

#include <cstdio>

#include "common/scene/check_spectrum.h"
#include "common/spectral/files/bispectral_file.h"
#include "common/spectral/lines.h"

namespace metamer {
namespace {

/// A share below which nobody is told of it.
constexpr double unnoticed_share = 0.01;

Result<NotedFluorescence> matrix_of(const std::string& file, const std::string& field,
                                    const AssetReader& assets) {
  auto matrix = assets(file).and_then(
      [&](const std::string& bytes) { return read_bispectral_file(bytes, file); });
  if (!matrix) {
    matrix.error().field = field + ".file";
    return tl::unexpected(std::move(matrix.error()));
  }
  return NotedFluorescence{*std::move(matrix)};
}

}  // namespace

Result<NotedFluorescence> load_fluorescence(const v1::Fluorescence& message,
                                            const std::string& field, const AssetReader& assets) {
  if (!message.file().empty()) return matrix_of(message.file(), field, assets);
  auto excitation = load_noted_spectrum(message.excitation(), field + ".excitation",
                                        SpectrumRole::excitation, assets);
  if (!excitation) return tl::unexpected(std::move(excitation.error()));
  auto emission =
      load_noted_spectrum(message.emission(), field + ".emission", SpectrumRole::emission, assets);
  if (!emission) return tl::unexpected(std::move(emission.error()));
  if (excitation->spectrum.nm.size() < 2)
    return tl::unexpected(Problem{.field = field + ".excitation",
                                  .file = {},
                                  .message = "an excitation needs two samples at least"});

  NotedFluorescence result{
      Fluorophore{std::move(excitation->spectrum), as_emission(std::move(emission->spectrum)),
                  message.quantum_yield()},
      std::move(excitation->notes)};
  result.notes.insert(result.notes.end(), emission->notes.begin(), emission->notes.end());
  const double share = left_out_share(std::get<Fluorophore>(result.fluorescence));
  if (share > unnoticed_share) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "%.2g %% of its emission would be at shorter wavelengths than what it absorbs of "
                  "white light, and is left out",
                  100 * share);
    result.notes.push_back(text);
  }
  return result;
}

void check_fluorescences(const v1::Scene& scene, const AssetReader& assets, Findings& findings) {
  for (int i = 0; i < scene.material_size(); ++i) {
    const v1::Material& material = scene.material(i);
    if (!material.has_fluorescence()) continue;
    const std::string field = indexed("material", static_cast<std::size_t>(i));
    auto loaded = load_fluorescence(material.fluorescence(), field + ".fluorescence", assets);
    if (!loaded && material.fluorescence().file().empty()) continue;  // for_each_spectrum has it
    if (!loaded) {
      findings.add(std::move(loaded.error()));
      continue;
    }
    Spectrum diffuse{{550}, {0}};
    if (material.has_diffuse()) {
      auto own =
          load_spectrum(material.diffuse(), field + ".diffuse", SpectrumRole::property, assets);
      if (!own) continue;
      diffuse = *std::move(own);
    }
    if (const auto fault = energy_fault(loaded->fluorescence, diffuse))
      findings.add(field + ".fluorescence", *fault);
  }
}

}  // namespace metamer
