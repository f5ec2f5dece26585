#include "client/tools/pictures/relit_scene.h"

#include <google/protobuf/util/message_differencer.h>

#include <utility>

#include "client/relight/reradiated_lights.h"
#include "client/tools/pictures/relit.h"

namespace metamer::client {
namespace {

using google::protobuf::util::MessageDifferencer;

v1::Light without_look(v1::Light light) {
  light.clear_spectrum();
  light.clear_luminance();
  return light;
}

v1::Material without_look(v1::Material material) {
  material.clear_diffuse();
  material.clear_specular();
  return material;
}

v1::Object without_look(const v1::Object& object) { return object; }

/// Whether two lists are the same but for what a look changes.
template <class List>
bool same_parts(const List& one, const List& other) {
  if (one.size() != other.size()) return false;
  for (int i = 0; i < one.size(); ++i)
    if (!MessageDifferencer::Equals(without_look(one[i]), without_look(other[i]))) return false;
  return true;
}

/// What a look can't change and differs; empty: nothing does.
std::string other_part(const v1::Scene& one, const v1::Scene& other) {
  if (!MessageDifferencer::Equals(one.camera(), other.camera())) return "the camera is another";
  if (!same_parts(one.light(), other.light())) return "a light stands elsewhere";
  if (!same_parts(one.material(), other.material())) return "a material reflects otherwise";
  if (!same_parts(one.object(), other.object())) return "an object is another";
  return {};
}

/// The settings that a look may have.
v1::Settings of_look(const v1::Settings& settings) {
  v1::Settings kept;
  kept.set_observer(settings.observer());
  kept.set_observer_file(settings.observer_file());
  if (settings.has_development()) *kept.mutable_development() = settings.development();
  return kept;
}

/// Swaps what differs, one part after the other.
class Relighting {
 public:
  Relighting(const Factors& factors, const AssetReader& assets)
      : relit_{.scene = factors.scene, .plan = factors.plan}, assets_(assets) {}

  Result<void> light(const v1::Light& from, const v1::Light& to, int index) {
    auto& light = *relit_.scene.mutable_light(index);
    if (from.luminance() != to.luminance() || from.has_luminance() != to.has_luminance())
      light.set_luminance(to.has_luminance() ? to.luminance() : 1);
    if (MessageDifferencer::Equals(from.spectrum(), to.spectrum())) return {};
    const std::string field = "light[" + std::to_string(index) + "].spectrum";
    return load_spectrum(to.spectrum(), field, SpectrumRole::emission, assets_)
        .map([&](const Spectrum& power) { swap_light(to.name(), power, relit_.scene); });
  }

  Result<void> material(const v1::Material& from, const v1::Material& to, int index) {
    const std::string field = "material[" + std::to_string(index) + "].";
    return paint(from.diffuse(), to.diffuse(), {index, v1::FACTOR_DIFFUSE}, field + "diffuse")
        .and_then([&] {
          return paint(from.specular(), to.specular(), {index, v1::FACTOR_SPECULAR},
                       field + "specular");
        });
  }

  Result<void> observer(const v1::Settings& from, const v1::Settings& to) {
    *relit_.plan.mutable_development() = to.development();
    if (from.observer() == to.observer() && from.observer_file() == to.observer_file()) return {};
    return load_observer(to, "settings", assets_).map([&](const Observer& observer) {
      swap_observer(observer, relit_.scene, relit_.plan);
    });
  }

  const v1::SceneFactors& scene() const { return relit_.scene; }

  RelitScene take() {
    plan_relit(relit_.scene, relit_.plan);
    return std::move(relit_);
  }

 private:
  Result<void> paint(const v1::Spectrum& from, const v1::Spectrum& to, const Property& property,
                     const std::string& field) {
    if (MessageDifferencer::Equals(from, to)) return {};
    return load_spectrum(to, field, SpectrumRole::property, assets_)
        .map([&](const Spectrum& reflectance) {
          swap_reflectance(property, reflectance, relit_.scene);
        });
  }

  RelitScene relit_;
  const AssetReader& assets_;
};

}  // namespace

Result<RelitScene> relit_scene(const Factors& factors, const v1::Scene& rendered,
                               const v1::Scene& wanted, const AssetReader& assets) {
  if (const std::string other = other_part(rendered, wanted); !other.empty()) return problem(other);
  if (factors.scene.light_size() != wanted.light_size() ||
      factors.scene.material_size() != wanted.material_size())
    return problem("the picture's factors are of another scene");
  Relighting relighting(factors, assets);
  for (int i = 0; i < wanted.light_size(); ++i)
    if (auto done = relighting.light(rendered.light(i), wanted.light(i), i); !done)
      return tl::unexpected(std::move(done.error()));
  for (int i = 0; i < wanted.material_size(); ++i)
    if (auto done = relighting.material(rendered.material(i), wanted.material(i), i); !done)
      return tl::unexpected(std::move(done.error()));
  if (auto done = relighting.observer(rendered.settings(), wanted.settings()); !done)
    return tl::unexpected(std::move(done.error()));
  if (const std::string fault = energy_fault(relighting.scene()); !fault.empty())
    return problem(fault);
  return relighting.take();
}

bool same_look(const v1::Scene& one, const v1::Scene& other) {
  if (one.light_size() != other.light_size() || one.material_size() != other.material_size())
    return false;
  for (int i = 0; i < one.light_size(); ++i)
    if (!MessageDifferencer::Equals(one.light(i), other.light(i))) return false;
  for (int i = 0; i < one.material_size(); ++i)
    if (!MessageDifferencer::Equals(one.material(i), other.material(i))) return false;
  return MessageDifferencer::Equals(of_look(one.settings()), of_look(other.settings()));
}

}  // namespace metamer::client
