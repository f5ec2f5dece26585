#include "common/mesh/text.h"

#include <charconv>
#include <cstdlib>
#include <limits>

#include "common/utf8.h"

namespace metamer::mesh_text {
namespace {

bool ends(const char* at, const char* end) { return at == end || is_space(*at); }

/// The sign that std::from_chars does not know.
const char* skip_plus(const char* at, const char* end) {
  return at != end && *at == '+' && at + 1 != end && at[1] != '-' ? at + 1 : at;
}

}  // namespace

std::optional<double> read_number(const char*& at, const char* end) {
  double value = 0;
  auto [rest, error] = std::from_chars(skip_plus(at, end), end, value);
  if (error == std::errc::invalid_argument) return std::nullopt;
  // Too large or too small: std::from_chars does not tell which.
  if (error == std::errc::result_out_of_range)
    value = std::strtod(std::string(at, rest).c_str(), nullptr);
  if (rest != end && *rest == '#') {
    value = std::numeric_limits<double>::quiet_NaN();
    rest = skip_word(rest, end);
  }
  if (!ends(rest, end)) return std::nullopt;
  at = rest;
  return value;
}

std::optional<std::int64_t> read_integer(const char*& at, const char* end) {
  std::int64_t value = 0;
  const auto [rest, error] = std::from_chars(skip_plus(at, end), end, value);
  if (error != std::errc() || !ends(rest, end)) return std::nullopt;
  at = rest;
  return value;
}

std::string utf8_name(std::string_view bytes) {
  if (auto text = to_utf8(bytes, "UTF-8")) return *std::move(text);
  return to_utf8(bytes, "ISO-8859-1").value_or(std::string());
}

tl::unexpected<Problem> problem_at(const std::string& file, int line, std::string message) {
  return tl::unexpected<Problem>(
      {.field = {}, .file = file, .line = line, .message = std::move(message)});
}

int line_of(std::string_view text, std::size_t place) {
  int line = 1;
  for (std::size_t i = 0; i < place && i < text.size(); ++i)
    if (text[i] == '\n' || (text[i] == '\r' && !(i + 1 < text.size() && text[i + 1] == '\n')))
      ++line;
  return line;
}

}  // namespace metamer::mesh_text
