#include "common/spectral/files/encoding.h"

#include <algorithm>
#include <optional>

#include "common/utf8.h"

namespace metamer {
namespace {

/// The byte order of UTF-16 without a mark: text of Europe's languages has a NUL in every second
/// place.
const char* unmarked_utf16(std::string_view bytes) {
  if (bytes.size() < 4 || bytes.size() % 2 != 0) return nullptr;
  const std::string_view begin = bytes.substr(0, 64);
  std::size_t nuls[2] = {};
  for (std::size_t i = 0; i < begin.size(); ++i) nuls[i % 2] += begin[i] == '\0' ? 1 : 0;
  const std::size_t half = begin.size() / 2;
  if (nuls[0] == 0 && nuls[1] == half) return "UTF-16LE";
  if (nuls[1] == 0 && nuls[0] == half) return "UTF-16BE";
  return nullptr;
}

std::string with_lf(const std::string& text) {
  std::string lines;
  lines.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r')
      lines += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      lines += '\n';
  }
  return lines;
}

/// Blanks that programs put where they want no new line, or between thousands: no-break space,
/// thin, figure and narrow no-break space.
std::string with_plain_blanks(std::string text) {
  for (const std::string_view blank : {"\xC2\xA0", "\xE2\x80\x87", "\xE2\x80\x89", "\xE2\x80\xAF"})
    for (std::size_t at = text.find(blank); at != std::string::npos; at = text.find(blank, at + 1))
      text.replace(at, blank.size(), " ");
  return text;
}

tl::unexpected<Problem> no_text(const std::string& file, std::string message) {
  return tl::unexpected<Problem>({.field = {}, .file = file, .message = std::move(message)});
}

}  // namespace

Result<std::string> utf8_text(std::string_view bytes, const std::string& file) {
  const bool little = bytes.starts_with("\xFF\xFE"), big = bytes.starts_with("\xFE\xFF");
  const char* utf16 = little ? "UTF-16LE" : big ? "UTF-16BE" : unmarked_utf16(bytes);
  if (little || big) bytes.remove_prefix(2);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);

  std::optional<std::string> text = to_utf8(bytes, utf16 != nullptr ? utf16 : "UTF-8");
  if (!text && utf16 != nullptr) return no_text(file, "the file is no sound UTF-16");
  if (!text) text = to_utf8(bytes, "ISO-8859-1");
  if (!text) return no_text(file, "the file's text can't be read");
  if (text->find('\0') != std::string::npos)
    return no_text(file, "the file is no text: it has a NUL byte");
  return with_plain_blanks(with_lf(*text));
}

}  // namespace metamer
