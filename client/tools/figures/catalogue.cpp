#include "client/tools/figures/catalogue.h"

#include <array>
#include <cstring>

namespace metamer::client {
namespace {

using models::Kind;

struct KindWords {
  Kind kind;
  const char* folder;
  const char* symbol;
};
constexpr std::array kinds = {
    KindWords{Kind::model, "model", "ρ"}, KindWords{Kind::diffuse, "diffuse", "(N·L)′"},
    KindWords{Kind::slope, "slope", "D"}, KindWords{Kind::attenuation, "attenuation", "G"}};

constexpr std::array trait_words = {
    TraitWords{models::weighted, "weighted", "Takes the material's diffuseness d."},
    TraitWords{models::highlighted, "highlighted", "Takes the material's specularness s."},
    TraitWords{models::has_fresnel, "fresnel", "Its highlight has a Fresnel term F."},
    TraitWords{models::has_facets, "facets",
               "Its highlight has a slope distribution D and a geometric attenuation G."},
    TraitWords{models::has_ambient, "ambient", "Reflects light where no lamp reaches."},
    TraitWords{models::anisotropic, "anisotropic", "Anisotropic: it needs the surface's tangent."},
    TraitWords{models::reciprocal, "reciprocal", "Reciprocal: light and viewer may change places."},
    TraitWords{models::symmetric_highlight, "symmetric-highlight",
               "Its highlight is the same with light and viewer exchanged."},
    TraitWords{models::diffracting, "diffracting",
               "Its highlight's geometry depends on wavelength."},
    TraitWords{models::conserving, "conserving", "Reflects no more light than it gets."},
};
constexpr const char* conserving_slope = "Normalised: ∫2hD dh = 1.";

}  // namespace

std::vector<CatalogueItem> catalogue() {
  std::vector<CatalogueItem> items;
  for (const KindWords& kind : kinds)
    for (const models::Entry& entry : models::registry(kind.kind))
      items.push_back({&entry, nullptr, models::kind_name(kind.kind), kind.folder, kind.symbol,
                       entry.name, entry.citation, entry.equation, entry.traits, entry.parameters});
  for (const models::FresnelForm& form : models::fresnel_forms)
    items.push_back({nullptr, &form, "Fresnel term", "fresnel", "F", form.name, form.citation,
                     form.equation, 0, form.parameters});
  return items;
}

Result<std::vector<CatalogueItem>> find_items(const std::string& name) {
  std::vector<CatalogueItem> found;
  std::vector<std::string> names;
  for (const CatalogueItem& item : catalogue()) {
    if (name == item.name) found.push_back(item);
    names.emplace_back(item.name);
  }
  if (found.empty())
    return problem("there is no model named " + quoted(name) + did_you_mean(name, names));
  return found;
}

std::vector<TraitWords> traits_of(const CatalogueItem& item) {
  std::vector<TraitWords> found;
  for (TraitWords words : trait_words) {
    if (!(item.traits & words.trait)) continue;
    const bool slope = item.entry && item.entry->kind == Kind::slope;
    if (slope && words.trait == models::conserving) words.sentence = conserving_slope;
    found.push_back(words);
  }
  return found;
}

}  // namespace metamer::client
