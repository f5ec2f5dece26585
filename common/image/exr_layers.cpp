#include "common/image/exr_layers.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "common/image/spectral_names.h"

namespace metamer {
namespace {

using Kind = ExrLayer::Kind;
using Names = std::vector<std::string>;

/// A–Z alone: what a file's names are told apart by else stays.
std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

/// Where a channel's own name begins, behind its layer. A spectrum's has points of its own.
std::size_t begin_of_name(std::string_view channel) {
  for (std::size_t at = 0; at < channel.size();) {
    const auto spectral = parse_spectral_channel(channel.substr(at));
    if (!spectral || *spectral) return at;  // one that is wrong is refused when it is read
    const std::size_t point = channel.find('.', at);
    if (point == std::string_view::npos) return at;
    at = point + 1;
  }
  return 0;
}

/// The channels of one layer, by what they are.
struct Group {
  std::map<std::string, std::string> colors;  ///< "r", "g", "b", "a", "X", "Y", "Z", "RY", "BY".
  Names spectral;

  bool has(std::initializer_list<const char*> names) const {
    return std::all_of(names.begin(), names.end(),
                       [&](const char* name) { return colors.contains(name); });
  }
  Names of(std::initializer_list<const char*> names) const {
    Names found;
    for (const char* name : names)
      if (const auto at = colors.find(name); at != colors.end()) found.push_back(at->second);
    return found;
  }
};

/// The one word for a colour's channel, "red" and "R" say; empty: it is another's.
std::string color_word(std::string_view name) {
  if (name == "X" || name == "Y" || name == "Z" || name == "RY" || name == "BY")
    return std::string(name);
  static constexpr std::array<std::pair<const char*, const char*>, 4> words = {
      {{"r", "red"}, {"g", "green"}, {"b", "blue"}, {"a", "alpha"}}};
  const std::string lower = in_lower_case(name);
  for (const auto& [letter, word] : words)
    if (lower == letter || lower == word) return letter;
  return {};
}

std::map<std::string, Group> groups_of(const ExrPart& part) {
  std::map<std::string, Group> groups;
  for (const ExrChannel& channel : part.channels) {
    const std::size_t begin = begin_of_name(channel.name);
    Group& group = groups[channel.name.substr(0, begin == 0 ? 0 : begin - 1)];
    const std::string name = channel.name.substr(begin);
    const auto spectral = parse_spectral_channel(name);
    if (!spectral || *spectral)
      group.spectral.push_back(channel.name);
    else if (const std::string word = color_word(name); !word.empty())
      group.colors.emplace(word, channel.name);
  }
  return groups;
}

std::optional<ExrLayer> layer_of(const Group& group) {
  ExrLayer layer;
  if (group.has({"a"})) layer.alpha = group.colors.at("a");
  if (!group.spectral.empty()) {
    layer.kind = Kind::spectral;
    layer.channels = group.spectral;
  } else if (group.has({"X", "Y", "Z"})) {
    layer.kind = Kind::xyz;
    layer.channels = group.of({"X", "Y", "Z"});
    layer.aside = group.of({"r", "g", "b"});
  } else if (group.has({"r", "g", "b"})) {
    layer.kind = Kind::rgb;
    layer.channels = group.of({"r", "g", "b"});
    layer.aside = group.of({"Y", "RY", "BY"});
  } else if (group.has({"Y"})) {
    layer.kind = Kind::grey;
    layer.channels = group.of({"Y"});
    layer.aside = group.of({"RY", "BY"});
  } else {
    return std::nullopt;
  }
  return layer;
}

/// Whether a layer's name, or else its part's, says that it is the picture.
bool is_picture(const ExrLayer& layer, const std::vector<ExrPart>& parts) {
  const ExrPart& part = parts[layer.part];
  std::string name = in_lower_case(!layer.layer.empty() ? layer.layer
                                   : parts.size() > 1   ? part.name
                                                        : "");
  if (const std::string view = "." + in_lower_case(part.view);
      view.size() > 1 && name.ends_with(view))
    name.resize(name.size() - view.size());
  name = name.substr(name.rfind('.') + 1);
  constexpr std::array words = {"",       "rgb",   "rgba",   "c",        "ci",
                                "beauty", "color", "colour", "combined", "composite",
                                "image",  "main",  "final",  "xyz"};
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return name == word; });
}

const char* content_of(const ExrLayer& layer) {
  switch (layer.kind) {
    case Kind::xyz:
      return "X Y Z";
    case Kind::rgb:
      return "R G B";
    case Kind::grey:
      return "Y";
    case Kind::spectral:
      return "spectra";
  }
  return "";
}

/// As messages list things, a few of them.
std::string listed(const Names& names) {
  constexpr std::size_t some = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(some, names.size()); ++i) text += (i ? ", " : "") + names[i];
  return text + (names.size() > some ? ", …" : "");
}

std::string listed(const std::vector<ExrLayer>& layers, const std::vector<ExrPart>& parts) {
  Names names;
  for (const ExrLayer& layer : layers) {
    const std::string name = name_of(layer, parts);
    names.push_back(name.empty() ? content_of(layer) : name + " (" + content_of(layer) + ")");
  }
  return listed(names);
}

/// "part" or "layer" of that name: as it stands, else in other letters' case; nothing: none.
template <class Name>
std::vector<ExrLayer> named(const std::vector<ExrLayer>& layers, const std::string& wanted,
                            const Name& name) {
  std::vector<ExrLayer> exact, alike;
  for (const ExrLayer& layer : layers) {
    if (name(layer) == wanted) exact.push_back(layer);
    if (in_lower_case(name(layer)) == in_lower_case(wanted)) alike.push_back(layer);
  }
  return exact.empty() ? alike : exact;
}

tl::unexpected<Problem> no_color(const std::vector<ExrPart>& parts) {
  Names channels;
  for (const ExrPart& part : parts)
    for (const ExrChannel& channel : part.channels) channels.push_back(quoted(channel.name));
  return problem("the picture has neither X Y Z nor R G B nor a spectrum; its channels are " +
                 listed(channels));
}

/// Keeps the layers that a choice names; whether it had a part in it.
Result<bool> keep_chosen(std::vector<ExrLayer>& layers, const std::vector<ExrPart>& parts,
                         const PictureChoice& choice) {
  const bool whole_file = parts.size() == 1 && parts[0].name.empty();
  bool chosen = false;
  if (choice.part && !whole_file) {
    const auto part_name = [&](const ExrLayer& layer) { return parts[layer.part].name; };
    auto kept = named(layers, *choice.part, part_name);
    if (kept.empty())
      return problem("no part " + quoted(*choice.part) + " is a picture; there are " +
                     listed(layers, parts));
    layers = std::move(kept);
    chosen = true;
  }
  const bool whole_part = layers.size() == 1 && layers[0].layer.empty();
  if (choice.layer && !(whole_part && !choice.layer->empty())) {
    auto kept = named(layers, *choice.layer, [](const ExrLayer& layer) { return layer.layer; });
    if (kept.empty())
      return problem("no layer " + quoted(*choice.layer) + " is a picture; there are " +
                     listed(layers, parts));
    layers = std::move(kept);
    chosen = true;
  }
  return chosen;
}

}  // namespace

std::vector<ExrLayer> find_layers(const std::vector<ExrPart>& parts) {
  std::vector<ExrLayer> layers;
  for (std::size_t part = 0; part < parts.size(); ++part)
    for (const auto& [name, group] : groups_of(parts[part]))
      if (auto layer = layer_of(group)) {
        layer->part = part;
        layer->layer = name;
        layers.push_back(std::move(*layer));
      }
  return layers;
}

std::string name_of(const ExrLayer& layer, const std::vector<ExrPart>& parts) {
  std::string name;
  if (parts.size() > 1) name = "part " + quoted(parts[layer.part].name);
  if (!layer.layer.empty()) name += (name.empty() ? "layer " : ", layer ") + quoted(layer.layer);
  return name;
}

Result<ChosenLayer> choose_layer(const std::vector<ExrPart>& parts, const PictureChoice& choice) {
  const std::vector<ExrLayer> all = find_layers(parts);
  if (all.empty()) return no_color(parts);
  std::vector<ExrLayer> meant = all;
  const Result<bool> by_choice = keep_chosen(meant, parts, choice);
  if (!by_choice) return tl::unexpected<Problem>(by_choice.error());
  if (meant.size() > 1) {
    std::vector<ExrLayer> pictures;
    std::copy_if(meant.begin(), meant.end(), std::back_inserter(pictures),
                 [&](const ExrLayer& layer) { return is_picture(layer, parts); });
    if (pictures.size() != 1) {
      const bool one_part = std::all_of(meant.begin(), meant.end(), [&](const ExrLayer& layer) {
        return layer.part == meant.front().part;
      });
      return problem("any of these could be the picture: " + listed(meant, parts) +
                     "; say which by " + (one_part ? "--layer" : "--part"));
    }
    meant = std::move(pictures);
  }

  ChosenLayer chosen{.layer = meant.front(), .by_choice = *by_choice, .notes = {}};
  if (!*by_choice && all.size() > 1) {
    std::vector<ExrLayer> others;
    std::copy_if(all.begin(), all.end(), std::back_inserter(others), [&](const ExrLayer& layer) {
      return layer.part != chosen.layer.part || layer.layer != chosen.layer.layer;
    });
    const std::string name = name_of(chosen.layer, parts);
    chosen.notes.push_back((name.empty() ? content_of(chosen.layer) : name) +
                           std::string(" is taken for the picture; beside it are ") +
                           listed(others, parts));
  }
  if (!chosen.layer.aside.empty())
    chosen.notes.push_back("channels " + listed(chosen.layer.aside) + " are left aside");
  return chosen;
}

}  // namespace metamer
