#include "common/utf8.h"

#include <iconv.h>

namespace metamer {
namespace {

/// Open for as long as it lives.
class Converter {
 public:
  explicit Converter(const char* encoding) : opened_(iconv_open("UTF-8", encoding)) {}
  Converter(const Converter&) = delete;
  Converter& operator=(const Converter&) = delete;
  ~Converter() {
    if (is_open()) iconv_close(opened_);
  }
  bool is_open() const { return opened_ != reinterpret_cast<iconv_t>(-1); }
  iconv_t get() const { return opened_; }

 private:
  iconv_t opened_;
};

}  // namespace

std::optional<std::string> to_utf8(std::string_view bytes, const char* encoding) {
  const Converter converter(encoding);
  if (!converter.is_open()) return std::nullopt;
  // Two bytes of Latin-1 or UTF-16 become three of UTF-8 at most.
  std::string text(2 * bytes.size() + 4, '\0');
  char* from = const_cast<char*>(bytes.data());  // iconv's declaration; it does not write there.
  char* to = text.data();
  std::size_t from_left = bytes.size(), to_left = text.size();
  if (iconv(converter.get(), &from, &from_left, &to, &to_left) != 0) return std::nullopt;
  text.resize(text.size() - to_left);
  return text;
}

void load_encodings() {
  // The C library keeps an encoding loaded while a converter of it is open: these stay.
  for (const char* encoding : text_encodings) static_cast<void>(iconv_open("UTF-8", encoding));
}

}  // namespace metamer
