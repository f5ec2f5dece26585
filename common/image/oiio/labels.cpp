// Text in pictures.
#include "common/image/labels.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>

#include "common/color/srgb.h"
#include "common/image/oiio/shared.h"

namespace metamer::oiio {
namespace {

namespace Algo = OIIO::ImageBufAlgo;

int width_of(const std::string& words) { return Algo::text_size(words, letters, font).width(); }

Algo::TextAlignX align_of(Label::Place place) {
  switch (place) {
    case Label::Place::left:
      return Algo::TextAlignX::Left;
    case Label::Place::center:
      return Algo::TextAlignX::Center;
    case Label::Place::right:
      return Algo::TextAlignX::Right;
  }
  return Algo::TextAlignX::Left;
}

/// As much as there is room for.
std::string shortened(std::string words, int width) {
  if (width <= 0 || width_of(words) <= width) return words;
  while (!words.empty() && width_of(words + "...") > width) words.pop_back();
  return words + "...";
}

}  // namespace

std::string ascii(std::string_view words) {
  std::string text;
  for (const char c : words)
    if ((c & 0xC0) != 0x80) text += c >= 0x20 && c < 0x7F ? c : '?';  // one mark a letter
  return text;
}

Result<void> draw_labels(Image& image, const std::vector<Label>& labels) {
  OIIO::ImageBuf all(OIIO::ImageSpec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT),
                     image.pixels.data());
  for (const Label& label : labels) {
    const Xyz white = srgb::to_xyz({label.grey, label.grey, label.grey});
    const float ink[] = {static_cast<float>(white[0]), static_cast<float>(white[1]),
                         static_cast<float>(white[2])};
    const auto align = align_of(label.place);
    const std::string words = shortened(ascii(label.words), label.width);
    if (words.empty() || Algo::render_text(all, label.x, label.y, words, letters, font, ink, align))
      continue;
    all.geterror();
    return problem(std::string("text can't be drawn without ") + font +
                   "; install the package fonts-dejavu-core");
  }
  return {};
}

}  // namespace metamer::oiio
