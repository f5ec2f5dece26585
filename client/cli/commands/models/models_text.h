#pragma once

#include <string>
#include <vector>

#include "client/cli/json.h"
#include "client/tools/figures/catalogue.h"

/// How people and programs read the catalogue. Each text ends with a line break.
namespace metamer::cli {

Json item_json(const client::CatalogueItem& item);

/// The kinds, and under each a line an item: name and citation.
std::string list_text(const std::vector<client::CatalogueItem>& items);

/// Equation, paper, traits and parameters.
std::string show_text(const client::CatalogueItem& item);

}  // namespace metamer::cli
