// The difference picture. It is drawn with the numbers that the file will hold, and decoded at the
// end, so that it is written like any other picture.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/color/srgb.h"
#include "common/image/compare.h"
#include "common/image/oiio/shared.h"
#include "common/image/ramp.h"

namespace metamer::oiio {
namespace {

// Encoded sRGB.
constexpr Rgb ground = {0.10, 0.10, 0.10};
constexpr std::array<float, 3> ink = {0.92F, 0.92F, 0.92F};
// Pixels. A legend needs some width to be read, however small the picture.
constexpr int legend_height = 76, least_width = 420, margin = 14, bar_height = 14;

class Canvas {
 public:
  Canvas(int width, int height) : image_(make_image(width, height, {"X", "Y", "Z"})) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) set(x, y, ground);
  }
  void set(int x, int y, const Rgb& color) {
    std::transform(color.begin(), color.end(), image_.at(x, y),
                   [](double value) { return static_cast<float>(value); });
  }
  /// False: there is no font.
  bool text(int x, int y, const std::string& words, OIIO::ImageBufAlgo::TextAlignX align) {
    OIIO::ImageBuf all(OIIO::ImageSpec(image_.width, image_.height, 3, OIIO::TypeDesc::FLOAT),
                       image_.pixels.data());
    const bool drawn = OIIO::ImageBufAlgo::render_text(all, x, y, words, letters, font, ink, align);
    if (!drawn) all.geterror();
    return drawn;
  }
  Image decoded() && {
    for (std::size_t i = 0; i < image_.pixels.size(); i += 3) {
      srgb::Rgb linear{};
      for (std::size_t c = 0; c < 3; ++c)
        linear[c] = srgb::decode(static_cast<double>(image_.pixels[i + c]));
      const Xyz xyz = srgb::to_xyz(linear);
      for (std::size_t c = 0; c < 3; ++c) image_.pixels[i + c] = static_cast<float>(xyz[c]);
    }
    return std::move(image_);
  }

 private:
  Image image_;
};

/// As name_of, in ASCII.
const char* plain_name_of(Metric metric) {
  switch (metric) {
    case Metric::de00:
      return "Delta E 00";
    case Metric::deuv:
      return "Delta E*uv";
    case Metric::deab:
      return "Delta E*ab";
  }
  return "";
}

std::string counted_pixels(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " pixel" : " pixels");
}

/// What the picture can't show.
std::string remarks(const Difference& difference, double top) {
  const auto above = static_cast<std::size_t>(
      std::count_if(difference.values.begin(), difference.values.end(),
                    [&](double value) { return std::isfinite(value) && value > top; }));
  std::string text;
  if (above > 0)
    text = counted_pixels(above) + " above, up to " +
           number_text(std::round(difference.statistics.maximum * 100) / 100);
  if (difference.statistics.not_finite > 0)
    text += (text.empty() ? "" : "; ") + std::string("red: ") +
            counted_pixels(difference.statistics.not_finite) + " without a number";
  return text;
}

/// The scale with its numbers, the title above it and the remarks below. False: there is no font.
bool draw_legend(Canvas& canvas, int width, int y, double top, const std::string& title,
                 const std::string& remark) {
  using Align = OIIO::ImageBufAlgo::TextAlignX;
  const int from = margin, to = width - margin, bar = y + 22;
  for (int x = from; x < to; ++x)
    for (int row = bar; row < bar + bar_height; ++row)
      canvas.set(x, row, cubehelix(static_cast<double>(x - from) / (to - from - 1)));
  const int numbers = bar + bar_height + letters + 3;
  return canvas.text(from, y + 15, title, Align::Left) &&
         canvas.text(from, numbers, "0", Align::Left) &&
         canvas.text((from + to) / 2, numbers, number_text(top / 2), Align::Center) &&
         canvas.text(to, numbers, number_text(top), Align::Right) &&
         (remark.empty() || canvas.text(from, numbers + letters + 5, remark, Align::Left));
}

}  // namespace

Result<Image> false_color(const Difference& difference, Metric metric, double top,
                          std::string_view title) {
  if (!(top > 0)) top = scale_end(difference.statistics.percentile_99);
  const int width = std::max(difference.width, least_width);
  Canvas canvas(width, difference.height + legend_height);
  std::size_t i = 0;
  for (int y = 0; y < difference.height; ++y)
    for (int x = 0; x < difference.width; ++x)
      canvas.set((width - difference.width) / 2 + x, y, ramp_color(difference.values[i++], top));

  const std::string words = plain_name_of(metric) + (title.empty() ? "" : ", " + ascii(title));
  if (!draw_legend(canvas, width, difference.height, top, words, remarks(difference, top)))
    return problem(std::string("the legend can't be drawn without ") + font +
                   "; install the package fonts-dejavu-core");
  return std::move(canvas).decoded();
}

}  // namespace metamer::oiio
