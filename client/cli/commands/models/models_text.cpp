#include "client/cli/commands/models/models_text.h"

#include <algorithm>
#include <cstring>

#include "client/tools/figures/catalogue.h"

namespace metamer::cli {
namespace {

using client::CatalogueItem;
using client::TraitWords;

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

struct Row {
  std::string name, value, range;
  const char* meaning;
};

std::string parameter_table(std::span<const models::Parameter> parameters) {
  // Measure the columns.
  std::vector<Row> rows = {{"parameter", "default", "range", "meaning"}};
  for (const models::Parameter& one : parameters) {
    const std::string unit = one.unit[0] ? std::string(" ") + one.unit : std::string();
    rows.push_back({one.name, number_text(one.default_value),
                    number_text(one.min) + " to " + number_text(one.max) + unit, one.meaning});
  }
  std::size_t name = 0, value = 0, range = 0;
  for (const Row& row : rows) {
    name = std::max(name, row.name.size());
    value = std::max(value, row.value.size());
    range = std::max(range, row.range.size());
  }

  std::string text;
  for (const Row& row : rows)
    text += "  " + padded(row.name, name + 2) + padded(row.value, value + 2) +
            padded(row.range, range + 2) + row.meaning + "\n";
  return text;
}

}  // namespace

Json item_json(const CatalogueItem& item) {
  Json traits = Json::array(), parameters = Json::array();
  for (const TraitWords& trait : client::traits_of(item)) traits.push_back(trait.word);
  for (const models::Parameter& one : item.parameters)
    parameters.push_back({{"name", one.name},
                          {"default", one.default_value},
                          {"min", one.min},
                          {"max", one.max},
                          {"unit", one.unit},
                          {"meaning", one.meaning}});
  return {{"kind", item.kind},         {"name", item.name}, {"citation", item.citation},
          {"equation", item.equation}, {"traits", traits},  {"parameters", parameters}};
}

std::string list_text(const std::vector<CatalogueItem>& items) {
  std::size_t width = 0;
  for (const CatalogueItem& item : items) width = std::max(width, std::strlen(item.name));
  std::string text;
  const char* kind = "";
  for (const CatalogueItem& item : items) {
    if (std::strcmp(kind, item.kind) != 0) text += std::string(item.kind) + "\n";
    kind = item.kind;
    text += "  " + padded(item.name, width + 2) + item.citation + "\n";
  }
  return text;
}

std::string show_text(const CatalogueItem& item) {
  std::string text = std::string(item.name) + ": " + item.kind + "\n";
  text += "  " + std::string(item.symbol) + " = " + item.equation + "\n";
  text += "  " + std::string(item.citation) + "\n";
  for (const TraitWords& trait : client::traits_of(item))
    text += "  " + std::string(trait.sentence) + "\n";
  return item.parameters.empty() ? text : text + "\n" + parameter_table(item.parameters);
}

}  // namespace metamer::cli
