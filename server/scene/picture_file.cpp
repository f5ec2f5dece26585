#include "server/scene/picture_file.h"

#include <algorithm>
#include <numeric>

#include "common/image/read_exr.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"

namespace metamer {

bool PictureFile::is_png() const { return has_extension(file_, ".png"); }

Result<PictureFile::Pixels> PictureFile::read(const std::string& bytes, PngSamples samples,
                                              const Choose& choose) const {
  const PictureSource source(bytes, file_);
  if (is_png()) {
    auto png = read_png(source, samples);
    if (!png) return at(".file", std::move(png.error()));
    const auto chosen = choose(png->image.channels);
    if (!chosen) return tl::unexpected(chosen.error());
    Pixels pixels{std::move(png->image), {}, png->bits};
    const std::vector<std::string>& known = pixels.image.channels;
    for (const std::string& name : *chosen)
      pixels.places.push_back(
          static_cast<std::size_t>(std::find(known.begin(), known.end(), name) - known.begin()));
    return pixels;
  }
  const auto parts = read_exr_parts(source);
  if (!parts) return at(".file", parts.error());
  std::vector<std::string> known;
  for (const ExrChannel& channel : parts->front().channels) known.push_back(channel.name);
  const auto chosen = choose(known);
  if (!chosen) return tl::unexpected(chosen.error());
  // Before there is memory taken for it.
  const PixelWindow& display = parts->front().display;
  if (auto fits =
          check_size(display.width(), display.height(), static_cast<std::uint32_t>(chosen->size()));
      !fits)
    return tl::unexpected(std::move(fits.error()));
  auto image = read_exr(source, *parts, 0, *chosen);
  if (!image) return at(".file", std::move(image.error()));
  Pixels pixels{*std::move(image), std::vector<std::size_t>(chosen->size())};
  std::iota(pixels.places.begin(), pixels.places.end(), std::size_t{0});
  return pixels;
}

Result<void> PictureFile::check_channel(const std::string& channel,
                                        const std::vector<std::string>& known,
                                        const std::string& below) const {
  if (std::find(known.begin(), known.end(), channel) != known.end()) return {};
  return at(below, unknown_name("the file has no channel " + quoted(channel), channel, known));
}

tl::unexpected<Problem> PictureFile::wrong_channels(const std::vector<std::string>& known,
                                                    std::size_t wanted) const {
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "" : " ") + name;
  return at(".channel", "the file has " + std::to_string(known.size()) + " channels (" + names +
                            "), " + std::to_string(wanted) +
                            (wanted == 1 ? " is needed" : " are needed") +
                            ": name those that are meant");
}

Result<void> PictureFile::check_size(int width, int height, std::uint32_t weights) const {
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels <= limits::max_texture_weights / weights) return {};
  return at(".file", "has " + std::to_string(width) + " × " + std::to_string(height) +
                         " pixels of " + std::to_string(weights) + " weights; at most " +
                         std::to_string(limits::max_texture_weights) + " are allowed");
}

tl::unexpected<Problem> PictureFile::at(const std::string& below, Problem what) const {
  what.field = field_ + below;
  what.file = file_;
  return tl::unexpected(std::move(what));
}

tl::unexpected<Problem> PictureFile::at(const std::string& below, std::string message) const {
  return at(below, Problem{.field = {}, .file = {}, .message = std::move(message)});
}

tl::unexpected<Problem> PictureFile::at_pixel(const Image& image, std::size_t pixel,
                                              const std::string& what) const {
  const auto width = static_cast<std::size_t>(image.width);
  return at(".file", "pixel " + std::to_string(pixel % width) + ", " +
                         std::to_string(pixel / width) + " (from the upper left): " + what);
}

}  // namespace metamer
