#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/models/fresnel_forms.h"
#include "common/models/registry.h"
#include "common/problem.h"

namespace metamer::client {

/// What `metamer models` lists: a line of models.def, or a form of the Fresnel term.
struct CatalogueItem {
  const models::Entry* entry = nullptr;          ///< Null: a Fresnel form.
  const models::FresnelForm* fresnel = nullptr;  ///< Null: a line of models.def.

  const char* kind;    ///< "slope distribution"
  const char* folder;  ///< One word for it, which also starts the names of its figures: "slope".
  const char* symbol;  ///< What its equation gives: "D".
  const char* name;
  const char* citation;
  const char* equation;
  unsigned traits;  ///< Of models::Trait.
  std::span<const models::Parameter> parameters;
};

/// All of them, kind by kind.
std::vector<CatalogueItem> catalogue();

/// Those of that name, one or more: "schlick" is a model, a slope distribution, an attenuation and
/// a Fresnel form. Error: there is none.
Result<std::vector<CatalogueItem>> find_items(const std::string& name);

/// The traits as short words, "conserving", and in a sentence.
struct TraitWords {
  models::Trait trait;
  const char* word;
  const char* sentence;
};
std::vector<TraitWords> traits_of(const CatalogueItem& item);

}  // namespace metamer::client
