#include "client/tools/spectra/picture_spectra.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "client/tools/pictures/save_pictures.h"
#include "common/image/spectral_exr.h"

namespace metamer::client {
namespace {

/// Pixels, both corners included.
struct Rectangle {
  int left, top, right, bottom;
};

/// Takes "10x20" off the front of a text.
bool take_pixel(std::string_view& text, int& x, int& y) {
  for (int* const number : {&x, &y}) {
    if (number == &y) {
      if (!text.starts_with('x')) return false;
      text.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), *number);
    if (error != std::errc() || *number < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return true;
}

std::optional<Rectangle> rectangle_of(std::string_view text) {
  Rectangle found{};
  if (!take_pixel(text, found.left, found.top)) return std::nullopt;
  if (text.empty()) return Rectangle{found.left, found.top, found.left, found.top};
  if (!text.starts_with('-')) return std::nullopt;
  text.remove_prefix(1);
  if (!take_pixel(text, found.right, found.bottom) || !text.empty()) return std::nullopt;
  const auto [left, right] = std::minmax(found.left, found.right);
  const auto [top, bottom] = std::minmax(found.top, found.bottom);
  return Rectangle{left, top, right, bottom};
}

std::vector<double> mean_over(const SpectralImage& image, const Rectangle& where) {
  std::vector<double> mean(image.nm.size());
  for (int y = where.top; y <= where.bottom; ++y)
    for (int x = where.left; x <= where.right; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
          static_cast<std::size_t>(x);
      for (std::size_t k = 0; k < mean.size(); ++k)
        mean[k] += static_cast<double>(image.values[pixel * mean.size() + k]);
    }
  const double count = static_cast<double>(where.right - where.left + 1) *
                       static_cast<double>(where.bottom - where.top + 1);
  for (double& value : mean) value /= count;
  return mean;
}

}  // namespace

bool is_picture_of_spectra(const std::string& file) { return is_exr(file); }

Result<SpectrumFile> read_picture_spectrum(const std::string& file,
                                           const std::optional<std::string>& entry) {
  const auto wrong = [&](std::string message) {
    return tl::unexpected<Problem>({.field = {}, .file = file, .message = std::move(message)});
  };
  const auto where = entry ? rectangle_of(*entry) : std::nullopt;
  if (!where)
    return wrong("is a picture: name a pixel, such as " + metamer::quoted(file + "#10x20") +
                 ", or a rectangle to take the mean of, " + metamer::quoted(file + "#10x20-30x40"));
  const auto image = read_spectral_exr(file);
  if (!image) return tl::unexpected(image.error());
  if (!*image) return wrong("has no spectra");
  if (where->right >= (*image)->width || where->bottom >= (*image)->height)
    return wrong("has no pixel there: it has " + std::to_string((*image)->width) + " by " +
                 std::to_string((*image)->height));
  auto spectrum = make_spectrum((*image)->nm, mean_over(**image, *where));
  if (!spectrum) return wrong(spectrum.error().message);
  SpectrumFile result{
      .format = "a spectral EXR",
      .quantity = (*image)->reflectance ? Quantity::reflectance : Quantity::emission,
      .scale = Scale::one};
  result.spectra.push_back({.name = *entry, .spectrum = std::move(*spectrum)});
  return result;
}

}  // namespace metamer::client
