#include "common/image/png_pixels.h"

#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <memory>

namespace metamer {
namespace {

using Bytes = std::vector<unsigned char>;

/// A stream of zlib in pieces.
class Deflater {
 public:
  Deflater() : stream_(std::make_unique<isal_zstream>()), level_buffer_(ISAL_DEF_LVL1_DEFAULT) {
    isal_deflate_init(stream_.get());
    stream_->level = 1;
    stream_->level_buf = level_buffer_.data();
    stream_->level_buf_size = ISAL_DEF_LVL1_DEFAULT;
    stream_->gzip_flag = IGZIP_ZLIB;
  }

  /// Less than 4 GiB, and nothing after the last.
  void add(unsigned char* bytes, std::size_t size, bool is_last) {
    stream_->next_in = bytes;
    stream_->avail_in = static_cast<std::uint32_t>(size);
    stream_->end_of_stream = is_last ? 1 : 0;
    std::array<unsigned char, 65536> piece;
    do {
      stream_->next_out = piece.data();
      stream_->avail_out = piece.size();
      // It refuses what does not fit together above, and nothing else.
      [[maybe_unused]] const int done = isal_deflate(stream_.get());
      assert(done == COMP_OK);
      deflated_.insert(deflated_.end(), piece.data(), stream_->next_out);
    } while (stream_->avail_out == 0);
  }
  Bytes take() && { return std::move(deflated_); }

 private:
  std::unique_ptr<isal_zstream> stream_;
  Bytes level_buffer_, deflated_;
};

}  // namespace

Bytes png_pixels(std::size_t row, int height,
                 const std::function<void(int y, unsigned char* row)>& fill) {
  constexpr unsigned char up = 2;
  constexpr std::size_t piece = 1 << 17;  // stays in the processor's cache
  const auto rows = static_cast<int>(std::max<std::size_t>(1, piece / (row + 1)));
  Deflater deflater;
  Bytes above(row), here(row),
      filtered((row + 1) * static_cast<std::size_t>(std::min(rows, height)));
  unsigned char* to = filtered.data();
  for (int y = 0; y < height; ++y) {
    fill(y, here.data());
    *to++ = up;
    std::transform(
        here.begin(), here.end(), above.begin(), to,
        [](unsigned char a, unsigned char b) { return static_cast<unsigned char>(a - b); });
    to += row;
    above.swap(here);
    const bool is_last = y + 1 == height;
    if (!is_last && (y + 1) % rows != 0) continue;
    deflater.add(filtered.data(), static_cast<std::size_t>(to - filtered.data()), is_last);
    to = filtered.data();
  }
  return std::move(deflater).take();
}

}  // namespace metamer
