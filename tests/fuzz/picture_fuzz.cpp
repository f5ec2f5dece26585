// The readers of pictures against any bytes: a PNG or an EXR, by how they begin.

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <zlib.h>

#include "check.h"
#include "common/image/read_exr_xyz.h"
#include "common/image/read_png_xyz.h"

namespace {

using metamer::fuzz::check;

/// A picture that is only large takes long, and nothing is learnt of it.
constexpr std::size_t most_pixels = std::size_t{1} << 20;

/// Bytes as a file, without one in any folder.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : descriptor_(memfd_create("picture", MFD_CLOEXEC)) {
    check(descriptor_ >= 0 &&
              write(descriptor_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
          "the input can be written");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(descriptor_); }
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i)
    number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

/// The sums of a PNG's chunks made right, so that what is in them is read.
std::string with_right_sums(std::string_view bytes) {
  std::string png(bytes);
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::size_t size = number_at(png, at);
    if (size > png.size() - at - 12) break;
    const uLong sum =
        crc32(0, reinterpret_cast<const Bytef*>(png.data()) + at + 4, static_cast<uInt>(size + 4));
    for (std::size_t i = 0; i < 4; ++i)
      png[at + 8 + size + i] = static_cast<char>(sum >> (24 - 8 * i) & 0xFF);
    at += 12 + size;
  }
  return png;
}

template <class Value>
bool is_problem(const metamer::Result<Value>& result) {
  if (result) return false;
  check(!result.error().message.empty(), "a problem says something");
  check(result.error().message.find('\n') == std::string::npos, "a problem is one line");
  return true;
}

void check_picture(const metamer::Result<metamer::XyzPicture>& picture) {
  if (is_problem(picture)) return;
  const metamer::Image& image = picture->image;
  check(image.width > 0 && image.height > 0 && image.channels.size() == 3, "it is a picture");
  check(image.pixels.size() == std::size_t{3} * static_cast<std::size_t>(image.width) *
                                   static_cast<std::size_t>(image.height),
        "it has all its pixels");
  check(!picture->what.empty(), "what it is has been said");
}

void read_png_bytes(std::string_view bytes) {
  if (bytes.size() >= 24 &&
      std::uint64_t{number_at(bytes, 16)} * number_at(bytes, 20) > most_pixels)
    return;
  const auto picture = metamer::read_png_xyz(MemoryFile(bytes).path());
  check_picture(picture);
  if (picture)
    check(std::all_of(picture->image.pixels.begin(), picture->image.pixels.end(),
                      [](float value) { return std::isfinite(value); }),
          "a PNG's numbers are finite");
}

bool is_large(const metamer::PixelWindow& window) {
  const auto side = [](int from, int to) { return std::int64_t{to} - from + 1; };
  return side(window.x0, window.x1) * side(window.y0, window.y1) >
         static_cast<std::int64_t>(most_pixels);
}

void read_exr_bytes(std::string_view bytes) {
  const MemoryFile file(bytes);
  const auto parts = metamer::read_exr_parts(file.path());
  if (is_problem(parts)) return;
  check(!parts->empty(), "an EXR has parts");
  for (const metamer::ExrPart& part : *parts)
    if (is_large(part.display) || is_large(part.data)) return;
  const metamer::Spectrum white{.nm = {360, 830}, .values = {1, 1}};
  check_picture(metamer::read_exr_xyz(file.path(), {.under = &white}, {}));
  for (const metamer::ExrLayer& layer : metamer::find_layers(*parts)) {
    check(layer.part < parts->size(), "a layer is in a part");
    const metamer::PictureChoice choice{.part = (*parts)[layer.part].name, .layer = layer.layer};
    check_picture(metamer::read_exr_xyz(file.path(), {.under = &white}, choice));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with('\x76') || bytes.starts_with('/')) {
    read_exr_bytes(bytes);
  } else {
    read_png_bytes(bytes);
    read_png_bytes(with_right_sums(bytes));
  }
  return 0;
}
