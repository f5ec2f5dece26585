#include "common/image/write_png.h"

#include <png.h>

#include <csetjmp>

#include "common/image/png_pixels.h"

namespace metamer {
namespace {

using Bytes = std::vector<unsigned char>;

/// What libpng's calls back to us need.
struct Output {
  Bytes bytes;
  std::string error;
};

void append(png_structp png, png_bytep data, std::size_t size) {
  Bytes& bytes = static_cast<Output*>(png_get_io_ptr(png))->bytes;
  bytes.insert(bytes.end(), data, data + size);
}

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  static_cast<Output*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void describe(png_structp png, png_infop info, const PngDescription& description,
              std::vector<png_text>& texts) {
  png_set_IHDR(png, info, static_cast<png_uint_32>(description.width),
               static_cast<png_uint_32>(description.height), description.bits, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (description.icc_profile.empty())
    png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
  else
    png_set_iCCP(png, info, "profile", PNG_COMPRESSION_TYPE_BASE,
                 reinterpret_cast<png_const_bytep>(description.icc_profile.data()),
                 static_cast<png_uint_32>(description.icc_profile.size()));
  png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
}

/// False: libpng jumped back here, over frames that have nothing to destroy.
bool write(png_structp png, png_infop info, const PngDescription& description,
           std::vector<png_text>& texts, const Bytes& pixels) {
  if (setjmp(png_jmpbuf(png))) return false;
  describe(png, info, description, texts);
  png_write_info(png, info);
  png_write_chunk(png, reinterpret_cast<png_const_bytep>("IDAT"), pixels.data(), pixels.size());
  png_write_chunk(png, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
  return true;
}

std::vector<png_text> to_texts(const std::map<std::string, std::string>& from) {
  std::vector<png_text> texts;
  for (const auto& [key, text] : from) {
    png_text one{};
    one.compression = PNG_ITXT_COMPRESSION_NONE;
    one.key = const_cast<char*>(key.c_str());
    one.text = const_cast<char*>(text.c_str());
    texts.push_back(one);
  }
  return texts;
}

}  // namespace

Result<Bytes> encode_png(const PngDescription& description,
                         const std::function<void(int y, unsigned char* row)>& fill) {
  const Bytes pixels = png_pixels(3 * static_cast<std::size_t>(description.width) *
                                      static_cast<std::size_t>(description.bits / 8),
                                  description.height, fill);
  Output output;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &output, fail, ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  bool good = false;
  if (info) {
    png_set_write_fn(png, &output, append, nullptr);
    std::vector<png_text> texts = to_texts(description.texts);
    good = write(png, info, description, texts, pixels);
  }
  png_destroy_write_struct(&png, &info);
  if (!good)
    return problem("can't encode the picture: " +
                   (output.error.empty() ? std::string("out of memory") : output.error));
  return std::move(output.bytes);
}

}  // namespace metamer
