#include "client/cli/commands/relight/file_names.h"

#include <set>
#include <string_view>

namespace metamer::cli {
namespace {

const std::string light_mark = "{light}", material_mark = "{material}";

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
}

/// A label without what a shell or a file system takes for something else: "lamps-warm".
std::string plain_word(const std::string& label) {
  std::string word;
  for (const char c : label) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
                       (c >= 'a' && c <= 'z') ||
                       std::string_view("._-+").find(c) != std::string_view::npos;
    word += plain ? c : '-';
  }
  return word;
}

/// Why several pictures can't be written into files of that name. Empty: they can.
std::string pattern_fault(const std::string& pattern, const std::string& mark, const char* what,
                          std::size_t count) {
  if (count == 1 || pattern.find(mark) != std::string::npos) return {};
  return metamer::quoted(pattern) + " needs " + mark + " in its name, as there are " +
         std::to_string(count) + " " + what;
}

}  // namespace

std::string file_name(const std::string& pattern, const Variant& light, const Variant& material) {
  std::string name = pattern;
  replace_all(name, light_mark, plain_word(light.label));
  replace_all(name, material_mark, plain_word(material.label));
  return name;
}

Result<std::vector<std::string>> file_names(const std::vector<std::string>& patterns,
                                            const std::vector<Variant>& lights,
                                            const std::vector<Variant>& materials) {
  std::vector<std::string> names;
  for (const std::string& pattern : patterns) {
    for (const std::string& fault :
         {pattern_fault(pattern, light_mark, "lights", lights.size()),
          pattern_fault(pattern, material_mark, "materials", materials.size())})
      if (!fault.empty()) return problem(fault);
    std::set<std::string> own;
    for (const Variant& light : lights)
      for (const Variant& material : materials) {
        names.push_back(file_name(pattern, light, material));
        if (!own.insert(names.back()).second)
          return problem("two pictures would be called " + metamer::quoted(names.back()) +
                         ": their spectra have one name");
      }
  }
  return names;
}

}  // namespace metamer::cli
