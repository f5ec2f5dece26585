#include "common/mesh/obj/materials.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/mesh/obj/lines.h"
#include "common/mesh/text.h"
#include "common/problem.h"

namespace metamer {
namespace {

using mesh_text::skip_space;

/// Takes the first word off a line.
std::string_view take_word(std::string_view& line) {
  const char* const end = line.data() + line.size();
  const char* const begin = skip_space(line.data(), end);
  const char* const after = mesh_text::skip_word(begin, end);
  line = {after, static_cast<std::size_t>(end - after)};
  return {begin, static_cast<std::size_t>(after - begin)};
}

std::string rest_of(std::string_view line) {
  while (!line.empty() && mesh_text::is_space(line.front())) line.remove_prefix(1);
  while (!line.empty() && mesh_text::is_space(line.back())) line.remove_suffix(1);
  return mesh_text::utf8_name(line.substr(0, 4096));
}

std::optional<double> finite_number(std::string_view& line) {
  const char* const end = line.data() + line.size();
  const char* at = skip_space(line.data(), end);
  const auto value = mesh_text::read_number(at, end);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  line = {at, static_cast<std::size_t>(end - at)};
  return value;
}

/// Nothing but blanks is before that place on its line.
bool begins_line(std::string_view text, std::size_t at) {
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
  return at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r';
}

/// r g b, or r alone for all three.
std::optional<Double3> color_in(std::string_view line) {
  const auto red = finite_number(line);
  if (!red) return std::nullopt;
  const auto green = finite_number(line);
  if (!green) {
    const bool alone = rest_of(line).empty() || rest_of(line).front() == '#';
    return alone ? std::optional<Double3>({*red, *red, *red}) : std::nullopt;
  }
  const auto blue = finite_number(line);
  if (!blue) return std::nullopt;
  return Double3{*red, *green, *blue};
}

class MtlReader {
 public:
  MtlFile read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    obj::Lines lines(text, obj::line_end(text));
    std::string_view line;
    while (lines.next(line)) {
      number_ = lines.number() + 1;
      statement(take_word(line), line);
    }
    if (bad_lines_ > max_notes)
      file_.notes.push_back(std::to_string(bad_lines_ - max_notes) + " more lines of it");
    return std::move(file_);
  }

 private:
  static constexpr std::size_t max_notes = 10;

  void statement(std::string_view word, std::string_view rest) {
    if (word == "newmtl") return begin(rest_of(rest));
    if (now_ == nullptr) return;
    if (word == "Kd") return set(now_->diffuse, color_in(rest), rest);
    if (word == "Ks") return set(now_->specular, color_in(rest), rest);
    if (word == "Ns") return set(now_->exponent, finite_number(rest), rest);
    if (word == "illum") now_->shows_highlight = finite_number(rest).value_or(2) >= 2;
    if (word == "map_Kd") now_->is_textured = true;
    if (word == "d" || word == "Tr" || word == "Ke") other(word, rest);
  }

  void begin(const std::string& name) {
    now_ = nullptr;
    if (!names_.insert(name).second) return note("material " + quoted(name) + " once more");
    if (file_.materials.size() == max_mtl_names) return note("materials beyond the first 4096");
    now_ = &file_.materials.emplace_back();
    now_->name = name;
  }

  template <class Value>
  void set(std::optional<Value>& to, const std::optional<Value>& value, std::string_view rest) {
    if (value)
      to = value;
    else
      note(mesh_text::cited(rest) + " as a value of " + metamer::quoted(now_->name));
  }

  /// What is no opaque surface without light of its own.
  void other(std::string_view word, std::string_view rest) {
    const auto value = color_in(rest);
    const double nothing = word == "d" ? 1 : 0;
    if (!value || *value == Double3{nothing, nothing, nothing}) return;
    if (std::find(now_->left_out.begin(), now_->left_out.end(), word) == now_->left_out.end())
      now_->left_out.emplace_back(word);
  }

  void note(const std::string& what) {
    if (bad_lines_++ < max_notes)
      file_.notes.push_back("line " + std::to_string(number_) + ", " + what);
  }

  MtlFile file_;
  MtlMaterial* now_ = nullptr;  ///< The last of the file's, which no other has followed.
  std::set<std::string> names_;
  int number_ = 0;
  std::size_t bad_lines_ = 0;
};

}  // namespace

std::vector<std::string> mtl_names(std::string_view obj) {
  std::vector<std::string> names;
  // Of a large file few lines are of interest: the others are not looked at.
  constexpr std::string_view word = "mtllib";
  for (std::size_t at = obj.find(word);
       at != std::string_view::npos && names.size() < max_mtl_files;
       at = obj.find(word, at + word.size())) {
    if (!begins_line(obj, at)) continue;
    std::string_view rest = obj.substr(at, obj.find_first_of("\r\n", at) - at);
    if (take_word(rest) != word) continue;
    const std::string name = rest_of(rest);
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return names;
}

MtlFile read_mtl(std::string_view text) { return MtlReader().read(text); }

}  // namespace metamer
