#include "common/image/read_png.h"

#include <png.h>

#include <algorithm>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "common/image/picture_file.h"

namespace metamer {
namespace {

using Bytes = std::vector<unsigned char>;

/// What libpng's calls back to us need.
struct Said {
  std::string error;
  std::vector<std::string> warnings;
};

[[noreturn]] void keep_error(png_structp png, png_const_charp message) {
  static_cast<Said*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void keep_warning(png_structp png, png_const_charp message) {
  constexpr std::size_t enough = 64;
  std::vector<std::string>& warnings = static_cast<Said*>(png_get_error_ptr(png))->warnings;
  if (warnings.size() < enough) warnings.emplace_back(message);
}

/// libpng's reader of one file.
class Reader {
 public:
  explicit Reader(std::FILE* file)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &said, keep_error, keep_warning)),
        info(png ? png_create_info_struct(png) : nullptr) {
    if (!info) return;
    png_init_io(png, file);
    // libpng 1.6.39 does not know this chunk.
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS,
                                reinterpret_cast<png_const_bytep>("cICP"), 1);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }

  Said said;
  png_structp png;
  png_infop info;
};

/// All before the pixels, and how many bytes each row of the file has. False: libpng jumped back
/// here, over frames that have nothing to destroy.
bool read_info(png_structp png, png_infop info, PngSamples samples, std::size_t& stored_row) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_info(png, info);
  stored_row = png_get_rowbytes(png, info);
  if (samples == PngSamples::numbers) {
    png_set_packing(png);
  } else {
    png_set_palette_to_rgb(png);
    png_set_expand_gray_1_2_4_to_8(png);
    if (png_get_valid(png, info, PNG_INFO_tRNS)) png_set_tRNS_to_alpha(png);
  }
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  return true;
}

bool read_rows(png_structp png, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_read_image(png, rows);
  return true;
}

void read_cicp(Reader& reader, PngPicture& picture) {
  png_unknown_chunkp chunks = nullptr;
  const int count = png_get_unknown_chunks(reader.png, reader.info, &chunks);
  for (int i = 0; i < count; ++i) {
    if (std::memcmp(chunks[i].name, "cICP", 4) != 0) continue;
    if (chunks[i].size != 4) {
      picture.faults["cICP"] = "it has " + std::to_string(chunks[i].size) + " bytes, not 4";
      return;
    }
    std::copy_n(chunks[i].data, 4, picture.cicp.emplace().data());
    return;
  }
}

/// What the file says of its numbers, and what libpng would not take. It keeps a damaged cICP,
/// whose name it does not know.
void read_color(Reader& reader, PngPicture& picture) {
  read_cicp(reader, picture);
  png_structp png = reader.png;
  png_infop info = reader.info;
  png_charp name = nullptr;
  png_bytep profile = nullptr;
  png_uint_32 size = 0;
  int number = 0;
  if (png_get_iCCP(png, info, &name, &number, &profile, &size))
    picture.icc_profile.assign(reinterpret_cast<const char*>(profile), size);
  picture.srgb = png_get_sRGB(png, info, &number) != 0;
  double gamma = 0;
  if (png_get_gAMA(png, info, &gamma)) picture.gamma = gamma;
  std::array<double, 8> c{};
  if (png_get_cHRM(png, info, &c[0], &c[1], &c[2], &c[3], &c[4], &c[5], &c[6], &c[7]))
    picture.chromaticities = c;

  for (const auto& [chunk, valid] :
       {std::pair("cICP", false), std::pair("iCCP", !picture.icc_profile.empty()),
        std::pair("sRGB", picture.srgb), std::pair("gAMA", picture.gamma.has_value()),
        std::pair("cHRM", picture.chromaticities.has_value())})
    for (const std::string& warning : reader.said.warnings)
      if (!valid && warning.starts_with(std::string(chunk) + ": "))
        picture.faults.emplace(chunk, warning.substr(6));
}

std::vector<std::string> channel_names(int color_type) {
  std::vector<std::string> names = {"Y"};
  if (color_type == PNG_COLOR_TYPE_PALETTE) return names;
  if (color_type & PNG_COLOR_MASK_COLOR) names = {"R", "G", "B"};
  if (color_type & PNG_COLOR_MASK_ALPHA) names.emplace_back("A");
  return names;
}

/// Samples of 8 or 16 bits, the high byte first.
void to_floats(const Bytes& bytes, int bits, std::vector<float>& values) {
  if (bits == 8)
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(bytes[i]) / 255;
  else
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(bytes[2 * i] << 8 | bytes[2 * i + 1]) / 65535;
}

/// Whether so many bytes of rows can be in a file: deflate makes at most 1032 of one (zlib's
/// technical notes). What is cut short asks for no more memory than its size allows.
bool can_hold(const PictureSource& source, std::size_t bytes) {
  std::error_code error;
  const std::uintmax_t size =
      source.bytes ? source.bytes->size() : std::filesystem::file_size(source.name, error);
  return error || bytes / 1032 <= size;
}

tl::unexpected<Problem> unreadable(const std::filesystem::path& file, const std::string& why) {
  return file_problem(file, "can't read the picture: " + first_line(why));
}

using OpenFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
OpenFile open_source(const PictureSource& source) {
  if (!source.bytes) return {std::fopen(source.name.c_str(), "rb"), std::fclose};
  // Opened for reading, nothing is ever written there.
  return {fmemopen(const_cast<char*>(source.bytes->data()), source.bytes->size(), "rb"),
          std::fclose};
}

}  // namespace

Result<PngPicture> read_png(const PictureSource& source, PngSamples samples) {
  const std::filesystem::path& file = source.name;
  const OpenFile open = open_source(source);
  if (!open) return unreadable(file, std::strerror(errno));
  Reader reader(open.get());
  std::size_t stored_row = 0;
  if (!reader.info || !read_info(reader.png, reader.info, samples, stored_row))
    return unreadable(file, reader.said.error);

  PngPicture picture;
  const auto width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  const auto height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  std::vector<std::string> channels = channel_names(png_get_color_type(reader.png, reader.info));
  if (const auto good = check_size(file, width, height, channels.size()); !good)
    return tl::unexpected<Problem>(good.error());
  picture.bits = png_get_bit_depth(reader.png, reader.info);
  read_color(reader, picture);

  const std::size_t row = png_get_rowbytes(reader.png, reader.info);
  if (!can_hold(source, stored_row * static_cast<std::size_t>(height)))
    return unreadable(file, "it is cut short, or its size is wrong: " + std::to_string(width) +
                                " × " + std::to_string(height) + " pixels can't be in it");
  Bytes bytes(row * static_cast<std::size_t>(height));
  std::vector<png_bytep> rows;
  for (std::size_t at = 0; at < bytes.size(); at += row) rows.push_back(bytes.data() + at);
  if (!read_rows(reader.png, rows.data())) return unreadable(file, reader.said.error);
  picture.image = make_image(width, height, std::move(channels));
  to_floats(bytes, picture.bits, picture.image.pixels);
  return picture;
}

}  // namespace metamer
