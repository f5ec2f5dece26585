#include "client/session/film.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

#include "common/color/srgb.h"
#include "common/scene/limits.h"

namespace metamer::client {
namespace {

static_assert(std::endian::native == std::endian::little, "tiles are little-endian");

tl::unexpected<SessionError> broken(std::string message) {
  return session_error(SessionError::Kind::disconnected, std::move(message));
}

bool is_size(std::uint64_t width, std::uint64_t height) {
  return width > 0 && height > 0 && width <= limits::max_side && height <= limits::max_side &&
         width * height <= limits::max_pixels;
}

}  // namespace

Answer<Film> Film::make(const v1::Plan& plan) {
  if (!is_size(plan.width(), plan.height()))
    return broken("the server planned a picture of " + std::to_string(plan.width()) + "x" +
                  std::to_string(plan.height()) + " pixels");
  Film film;
  film.image_ =
      make_image(static_cast<int>(plan.width()), static_cast<int>(plan.height()), {"X", "Y", "Z"});
  film.missing_ = std::size_t{plan.width()} * plan.height();
  film.have_.assign(film.missing_, false);
  return film;
}

Answer<void> Film::add(const v1::Tile& tile) {
  const std::size_t width = static_cast<std::size_t>(image_.width);
  const std::size_t height = static_cast<std::size_t>(image_.height);
  const std::size_t row_bytes = std::size_t{tile.width()} * 3 * sizeof(float);

  // Distrust the rectangle: a wrong one would write outside the picture.
  const bool inside = std::uint64_t{tile.x()} + tile.width() <= width &&
                      std::uint64_t{tile.y()} + tile.height() <= height;
  if (!inside || tile.width() == 0 || tile.xyz().size() != row_bytes * tile.height())
    return broken("the server sent a tile that does not fit the picture");

  for (std::size_t row = 0; row < tile.height(); ++row) {
    const std::size_t first = (tile.y() + row) * width + tile.x();
    for (std::size_t pixel = first; pixel < first + tile.width(); ++pixel) {
      if (have_[pixel]) return broken("the server sent a tile twice");
      have_[pixel] = true;
    }
    std::memcpy(image_.pixels.data() + first * 3, tile.xyz().data() + row * row_bytes, row_bytes);
    missing_ -= tile.width();
  }
  return {};
}

Answer<Image> preview_image(const v1::Preview& preview) {
  const std::size_t pixels = std::size_t{preview.width()} * preview.height();
  if (!is_size(preview.width(), preview.height()) || preview.rgb().size() != pixels * 3)
    return broken("the server sent a preview that does not fit its size");
  Image image = make_image(static_cast<int>(preview.width()), static_cast<int>(preview.height()),
                           {"X", "Y", "Z"});
  for (std::size_t i = 0; i < pixels * 3; i += 3) {
    srgb::Rgb linear{};
    for (std::size_t c = 0; c < 3; ++c)
      linear[c] = srgb::decode(static_cast<unsigned char>(preview.rgb()[i + c]) / 255.0);
    const Xyz xyz = srgb::to_xyz(linear);
    for (std::size_t c = 0; c < 3; ++c) image.pixels[i + c] = static_cast<float>(xyz[c]);
  }
  return image;
}

}  // namespace metamer::client
