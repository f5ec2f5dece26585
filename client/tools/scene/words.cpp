#include "client/tools/scene/words.h"

#include <algorithm>

#include "common/scene/development.h"
#include "common/scene/schema.h"

namespace metamer::client {
namespace {

using google::protobuf::EnumDescriptor;
using google::protobuf::EnumValueDescriptor;

/// Null when the word names nothing.
const EnumValueDescriptor* find(const std::string& word, const EnumDescriptor& type) {
  for (int i = 0; i < type.value_count(); ++i)
    if (word_of(*type.value(i)) == word || type.value(i)->name() == word) return type.value(i);
  return nullptr;
}

}  // namespace

std::string word_of(const EnumValueDescriptor& value) {
  std::string word = value.name();
  std::transform(word.begin(), word.end(), word.begin(), [](char c) {
    if (c == '_') return '-';
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return word;
}

std::vector<std::string> words_of(const EnumDescriptor& type) {
  std::vector<std::string> words;
  for (int i = 0; i < type.value_count(); ++i) words.push_back(word_of(*type.value(i)));
  return words;
}

Result<int> value_named(const std::string& word, const char* what, const EnumDescriptor& type) {
  if (const EnumValueDescriptor* value = find(word, type)) return value->number();
  const std::vector<std::string> words = words_of(type);
  Problem unknown =
      metamer::unknown_name("no " + std::string(what) + " named " + quoted(word), word, words);
  if (unknown.meant.empty()) unknown.message += "; there are " + join(words);
  return tl::unexpected(std::move(unknown));
}

Result<v1::Observer> observer_named(const std::string& word) {
  return value_named(word, "observer", *v1::Observer_descriptor()).map([](int value) {
    return static_cast<v1::Observer>(value);
  });
}

Result<v1::Adaptation> adaptation_named(const std::string& word) {
  for (int value = 0; value < v1::Adaptation_ARRAYSIZE; ++value) {
    const auto adaptation = static_cast<v1::Adaptation>(value);
    if (find_adaptation(word) == to_adaptation(adaptation)) return adaptation;
  }
  return tl::unexpected(
      metamer::unknown_name("no adaptation named " + quoted(word), word, adaptation_words()));
}

Result<v1::RgbSpace> rgb_space_named(const std::string& word) {
  for (int value = 0; value < v1::RgbSpace_ARRAYSIZE; ++value) {
    const auto space = static_cast<v1::RgbSpace>(value);
    if (rgb_space(to_standard_space(space)).word == word) return space;
  }
  return tl::unexpected(
      metamer::unknown_name("no RGB space named " + quoted(word), word, rgb_space_words()));
}

}  // namespace metamer::client
