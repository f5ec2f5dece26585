#include "server/scene/fluorescences.h"

#include <algorithm>
#include <map>

#include "common/color/xyz.h"
#include "common/scene/fluorescence.h"
#include "common/scene/limits.h"

namespace metamer {
namespace {

/// Where a light has data that are not 0, as_emission's lines among them.
std::array<double, 2> lit_range(const Spectrum& emission) {
  std::array<double, 2> range{emission.nm.back(), emission.nm.front()};
  for (std::size_t i = 0; i < emission.nm.size(); ++i) {
    if (emission.values[i] == 0) continue;
    range = {std::min(range[0], emission.nm[i]), std::max(range[1], emission.nm[i])};
  }
  return range;
}

std::string kind_and_name(const std::string& kind, const std::string& name) {
  return kind + " \"" + name + "\"";
}

/// What one material's fluorescence says of one light.
void notice_light(const RenderLight& light, const RenderMaterial& material,
                  const std::array<double, 2>& excited, RenderScene& scene) {
  const Spectrum& emission = scene.emissions[light.emission];
  const std::string& field = scene.emission_fields[light.emission];
  const auto [from, to] = lit_range(emission);
  const std::string paper = kind_and_name("material", material.name),
                    lamp = kind_and_name("light", light.name);
  if (from < observer_from_nm && excited[0] < observer_from_nm && to > excited[0])
    scene.notices.push_back({field, "wavelengths of " + lamp + " count from " +
                                        number_text(std::max(from, excited[0])) + " nm on, where " +
                                        paper + " absorbs to re-radiate"});
  else if (emission.nm.front() > excited[0] && emission.values.front() > 0)
    scene.notices.push_back({field, "the data of " + lamp + " begin at " +
                                        number_text(emission.nm.front()) + " nm: " + paper +
                                        " absorbs to re-radiate from " + number_text(excited[0]) +
                                        " nm on, where this light is taken for dark"});
}

/// What the scene's fluorescences make of its emissions, as its observer sees them. An emission of
/// which the observer sees nothing stays dark, and so does what it excites.
void fill_reradiated(RenderScene& scene) {
  for (const Spectrum& emission : scene.emissions) {
    const double y = emission_xyz(emission, scene.observer)[1], scale = y > 0 ? 1 / y : 0;
    for (const Fluorescence& fluorescence : scene.fluorescences) {
      RenderScene::Reradiated& one = scene.reradiated.emplace_back();
      one.power = reradiated(fluorescence, emission);
      for (double& value : one.power.values) value *= scale;
      one.luminance = emission_xyz(one.power, scene.observer)[1];
    }
  }
}

/// Says from where lights count for fluorescences; which lights have no data there; which
/// fluorescences no light reaches.
void notice_excitation(RenderScene& scene) {
  std::vector<bool> told(scene.fluorescences.size());
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const RenderMaterial& material = scene.materials[m];
    if (!material.fluorescence || told[*material.fluorescence]) continue;
    const std::uint32_t index = *material.fluorescence;
    told[index] = true;
    const auto excited = excited_range(scene.fluorescences[index]);
    std::vector<bool> known(scene.emissions.size());
    bool reached = false;
    for (std::size_t l = 0; l < scene.lights.size(); ++l) {
      const RenderLight& light = scene.lights[l];
      if (known[light.emission]) continue;
      known[light.emission] = true;
      const std::vector<double>& out =
          scene.reradiated[scene.reradiated_index(static_cast<std::uint32_t>(l), index)]
              .power.values;
      reached |= std::any_of(out.begin(), out.end(), [](double value) { return value > 0; });
      if (excited) notice_light(light, material, *excited, scene);
    }
    if (!reached)
      scene.notices.push_back(
          {scene.fluorescence_fields[index],
           kind_and_name("material", material.name) + " re-radiates nothing: no light excites it"});
  }
}

/// Loads those of the materials, each once.
class FluorescenceLoader {
 public:
  FluorescenceLoader(const AssetReader& assets, RenderScene& scene)
      : assets_(assets), scene_(scene) {}

  void add(const v1::Material& message, RenderMaterial& material, const std::string& field) {
    const auto [place, is_new] =
        known_.try_emplace(message.fluorescence().SerializeAsString(),
                           static_cast<std::uint32_t>(scene_.fluorescences.size()));
    if (is_new && !load(message.fluorescence(), field)) return;
    material.fluorescence = place->second;
    const auto fault =
        energy_fault(scene_.fluorescences[place->second], scene_.properties[material.diffuse]);
    if (fault) fail(field, *fault);
  }

  /// Bounds what they cost.
  std::vector<Problem> finish() {
    const std::size_t pairs = scene_.emissions.size() * scene_.fluorescences.size();
    if (pairs > limits::max_reradiated)
      fail(scene_.fluorescence_fields.front(),
           std::to_string(scene_.fluorescences.size()) + " fluorescences under " +
               std::to_string(scene_.emissions.size()) + " spectra of lights are " +
               std::to_string(pairs) + " spectra; at most " +
               std::to_string(limits::max_reradiated) + " are possible");
    if (cells_ > max_bispectral_cells)
      fail(scene_.fluorescence_fields.front(),
           "the scene's matrices have " + std::to_string(cells_) + " values; at most " +
               std::to_string(max_bispectral_cells) + " are possible");
    return std::move(problems_);
  }

 private:
  bool load(const v1::Fluorescence& message, const std::string& field) {
    auto loaded = load_fluorescence(message, field, assets_);
    if (!loaded) {
      problems_.push_back(std::move(loaded.error()));
      known_.erase(message.SerializeAsString());
      return false;
    }
    for (const std::string& note : loaded->notes) scene_.notices.push_back({field, note});
    if (const auto* matrix = std::get_if<BispectralMatrix>(&loaded->fluorescence))
      cells_ += matrix->values.size();
    scene_.fluorescences.push_back(std::move(loaded->fluorescence));
    scene_.fluorescence_fields.push_back(field);
    return true;
  }

  void fail(std::string field, std::string message) {
    problems_.push_back({.field = std::move(field), .file = {}, .message = std::move(message)});
  }

  const AssetReader& assets_;
  RenderScene& scene_;
  std::vector<Problem> problems_;
  std::map<std::string, std::uint32_t> known_;
  std::size_t cells_ = 0;  ///< Of all matrices.
};

}  // namespace

std::vector<Problem> add_fluorescences(const v1::Scene& message, const AssetReader& assets,
                                       RenderScene& scene) {
  FluorescenceLoader loader(assets, scene);
  for (int i = 0; i < message.material_size(); ++i)
    if (message.material(i).has_fluorescence())
      loader.add(message.material(i), scene.materials[static_cast<std::size_t>(i)],
                 "material[" + std::to_string(i) + "].fluorescence");
  std::vector<Problem> problems = loader.finish();
  if (!problems.empty() || scene.fluorescences.empty()) return problems;
  fill_reradiated(scene);
  notice_excitation(scene);
  return {};
}

}  // namespace metamer
