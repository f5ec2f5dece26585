#include "client/tools/spectra/scene_spectra.h"

#include <algorithm>
#include <map>

#include "common/scene/check_spectrum.h"
#include "common/scene/files.h"
#include "common/scene/reading.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

/// How a file is read, as it stands after @.
std::string words_of_reading(const v1::Spectrum& message) {
  const Reading reading = reading_of(message.reading());
  std::string words;
  if (reading.as) words += "@" + quantity_text(*reading.as);
  if (reading.unit) words += *reading.unit == WavelengthUnit::um ? "@um" : "@nm";
  if (reading.scale) words += *reading.scale == Scale::percent ? "@percent" : "@1";
  if (reading.clamp) words += "@clamp";
  if (const auto curve = interpolation_of(message)) words += "@" + word_of(*curve);
  return words;
}

/// Empty: no word says it.
std::string word_for(const v1::Spectrum& message, const fs::path& folder) {
  if (!message.line().empty()) return {};
  switch (message.source_case()) {
    case v1::Spectrum::kStandard:
      return message.standard();
    case v1::Spectrum::kFile:
      return (folder / message.file()).string() +
             (message.entry().empty() ? "" : "#" + message.entry()) + words_of_reading(message);
    case v1::Spectrum::kConstant:
    case v1::Spectrum::kSamples:
    case v1::Spectrum::kSunlight:
    case v1::Spectrum::SOURCE_NOT_SET:
      break;
  }
  return {};
}

/// Collects them, each once.
class SceneSpectraReader {
 public:
  explicit SceneSpectraReader(fs::path folder) : folder_(std::move(folder)) {}

  void read(const v1::Spectrum& message, const std::string& owner, const std::string& field,
            SpectrumRole role) {
    const std::string key =
        (role == SpectrumRole::emission ? "e" : "p") + message.SerializeAsString();
    if (const auto there = found_.find(key); there != found_.end()) {
      result_.spectra[there->second].spectrum.label += ", " + owner;
      return;
    }
    Result<WordedSpectrum> loaded = load(message, field, role);
    if (!loaded) {
      result_.problems.push_back(std::move(loaded.error()));
      return;
    }
    loaded->spectrum.label = owner;
    if (loaded->word.empty()) loaded->spectrum.name = owner;
    found_.emplace(key, result_.spectra.size());
    result_.spectra.push_back(std::move(*loaded));
  }
  SceneSpectra taken() && { return std::move(result_); }

 private:
  Result<WordedSpectrum> load(const v1::Spectrum& message, const std::string& field,
                              SpectrumRole role) const {
    const bool emission = role == SpectrumRole::emission;
    if (const std::string word = word_for(message, folder_); !word.empty()) {
      auto one = load_one(word, {.use = emission ? Use::emission : Use::property});
      if (one) return WordedSpectrum{word, std::move(*one)};
      one.error().problem.field = field;
      return tl::unexpected(std::move(one.error().problem));
    }
    auto spectrum = load_spectrum(message, field, role, [&](const std::string& name) {
      return read_file(folder_ / name, max_spectrum_file);
    });
    if (!spectrum) return tl::unexpected(std::move(spectrum.error()));
    return WordedSpectrum{{},
                          {.label = {},
                           .name = {},
                           .quantity = emission ? Quantity::emission : Quantity::reflectance,
                           .samples = std::move(*spectrum)}};
  }

  fs::path folder_;
  std::map<std::string, std::size_t> found_;
  SceneSpectra result_;
};

}  // namespace

SceneSpectra scene_spectra(const v1::Scene& scene, const fs::path& folder) {
  SceneSpectraReader reader(folder);
  for (int i = 0; i < scene.light_size(); ++i)
    if (scene.light(i).has_spectrum())
      reader.read(scene.light(i).spectrum(), scene.light(i).name(),
                  "light[" + std::to_string(i) + "].spectrum", SpectrumRole::emission);
  for (int i = 0; i < scene.material_size(); ++i) {
    const v1::Material& material = scene.material(i);
    const std::string field = "material[" + std::to_string(i) + "]";
    if (material.has_diffuse())
      reader.read(material.diffuse(), material.name(), field + ".diffuse", SpectrumRole::property);
    if (material.has_specular())
      reader.read(material.specular(), material.name() + " specular", field + ".specular",
                  SpectrumRole::property);
  }
  return std::move(reader).taken();
}

}  // namespace metamer::client
