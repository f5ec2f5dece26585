#include "server/service/ops/config_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "server/service/ops/option_value.h"

namespace metamer::service {

namespace {

constexpr std::size_t max_config_file = 1 << 20;
constexpr std::size_t comment_width = 100;

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const Section& section : all_sections()) names.push_back(section.name);
  return names;
}

const Option* find_option(const std::string& section, std::string_view name) {
  for (const Option& option : all_options())
    if (option.section == section && option.name == name) return &option;
  return nullptr;
}

/// " (it is in [store])" where another section has that option.
std::string elsewhere(std::string_view name) {
  for (const Option& option : all_options())
    if (option.name == name && !option.section.empty())
      return "; it is in [" + option.section + "]";
  return {};
}

/// Reads one file; collects what is wrong.
class Reader {
 public:
  Reader(std::string file, Settings& settings) : file_(std::move(file)), settings_(settings) {}

  void read(const toml::table& table) {
    const std::vector<std::string> names = section_names();
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        complain(key.source(), "there is no section or option " + quoted(name) + elsewhere(name) +
                                   did_you_mean(name, names));
      } else if (!node.is_table()) {
        complain(node.source(), quoted(name) + " is a section: [" + name + "]");
      } else {
        read_section(name, *node.as_table());
      }
    }
  }

  void complain(const toml::source_region& place, std::string message) {
    problems_.push_back({.field = {},
                         .file = file_,
                         .line = static_cast<int>(place.begin.line),
                         .column = static_cast<int>(place.begin.column),
                         .message = std::move(message)});
  }

  Problems problems() {
    std::sort(problems_.begin(), problems_.end(), [](const Problem& a, const Problem& b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    return std::move(problems_);
  }

 private:
  void read_section(const std::string& section, const toml::table& table) {
    std::vector<std::string> known;
    for (const Option& option : all_options())
      if (option.section == section) known.push_back(option.name);
    for (const auto& [key, node] : table) {
      const Option* option = find_option(section, key.str());
      if (!option) {
        const std::string other = elsewhere(key.str());
        complain(key.source(), "[" + section + "] has no option " + quoted(key.str()) +
                                   (other.empty() ? did_you_mean(key.str(), known) : other));
      } else if (const auto given = set(*option, settings_, value_of(node)); !given) {
        complain(node.source(), option->name + ": " + given.error().message);
      }
    }
  }

  /// What is none of these types comes out as a list with a zero byte, which no option takes.
  static OptionValue value_of(const toml::node& node) {
    if (const auto* flag = node.as_boolean()) return flag->get();
    if (const auto* whole = node.as_integer()) return whole->get();
    if (const auto* real = node.as_floating_point()) return real->get();
    if (const auto* text = node.as_string()) return text->get();
    std::vector<std::string> list;
    if (const auto* array = node.as_array(); array && array->is_homogeneous<std::string>()) {
      for (const auto& one : *array) list.push_back(one.as_string()->get());
      return list;
    }
    const auto* empty = node.as_array();
    if (!empty || !empty->empty()) list.emplace_back(1, '\0');
    return list;
  }

  std::string file_;
  Settings& settings_;
  Problems problems_;
};

/// A sentence as lines of comment.
std::string comment(const std::string& sentence) {
  std::string text, line = "#";
  std::istringstream words(sentence);
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > comment_width) {
      text += line + "\n";
      line = "#";
    }
    line += " " + word;
  }
  return text + line + "\n";
}

std::string option_text(const Option& option, const Settings& settings) {
  std::string meaning = option.meaning;
  meaning[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(meaning[0])));
  std::string text = comment(meaning + ". Value: " + expected_value(option) + ".");
  const auto value = toml_text(option, settings);
  return text + (value ? option.name + " = " + *value : "#" + option.name + " =") + "\n";
}

}  // namespace

tl::expected<void, Problems> read_config(const std::string& text, const std::string& file,
                                         Settings& settings) {
  Reader reader(file, settings);
  try {
    reader.read(toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    reader.complain(error.source(), std::string(error.description()));
  }
  Problems problems = reader.problems();
  if (problems.empty()) return {};
  return tl::unexpected(std::move(problems));
}

tl::expected<void, Problems> read_config_file(const std::string& file, Settings& settings) {
  const auto fail = [&](std::string message) {
    return tl::unexpected(Problems{{.field = {}, .file = file, .message = std::move(message)}});
  };
  std::ifstream stream(file, std::ios::binary);
  std::string text(max_config_file + 1, '\0');
  if (!stream.is_open()) return fail(std::string("can't be read: ") + std::strerror(errno));
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad() || (stream.fail() && !stream.eof())) return fail("can't be read");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > max_config_file) return fail("is over 1 MiB");
  return read_config(text, file, settings);
}

std::string config_text(const Settings& settings) {
  std::string text = comment("What metamerd is told: its options, by section. " +
                             std::string("metamerd --config reads ") + default_config_file +
                             "; the command line has the last word. Bytes are numbers or texts "
                             "(\"300MiB\"); times are seconds. SIGHUP has it read again.");
  for (const Section& section : all_sections()) {
    text += "\n" + comment(section.meaning) + "[" + section.name + "]\n";
    for (const Option& option : all_options())
      if (option.section == section.name) text += "\n" + option_text(option, settings);
  }
  return text;
}

}  // namespace metamer::service
