#include "common/image/read_png_xyz.h"

#include <algorithm>

#include "common/color/xyz.h"
#include "common/image/alpha.h"
#include "common/image/as_seen.h"
#include "common/image/icc.h"
#include "common/image/png_encoding.h"

namespace metamer {
namespace {

/// R, G, B or Y of every pixel, as stored, becomes X Y Z.
Result<Image> by_encoding(const Image& stored, const PngEncoding& encoding) {
  const auto to_xyz =
      make_rgb_space("", "", encoding.primaries, encoding.transfer).and_then(as_seen);
  if (!to_xyz) return problem("what its cHRM says makes no RGB space: " + to_xyz.error().message);
  Image xyz = make_image(stored.width, stored.height, {"X", "Y", "Z"});
  const std::size_t channels = stored.channels.size();
  for (std::size_t i = 0; i < xyz.pixels.size() / 3; ++i) {
    const float* const pixel = stored.pixels.data() + i * channels;
    Rgb rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = pixel[channels == 1 ? 0 : c];
      rgb[c] =
          decode(encoding.transfer, (value - encoding.black) / (encoding.white - encoding.black));
    }
    const Xyz seen = multiply(*to_xyz, rgb);
    for (std::size_t c = 0; c < 3; ++c) xyz.pixels[3 * i + c] = static_cast<float>(seen[c]);
  }
  return xyz;
}

Result<XyzPicture> by_profile(const Image& stored, const std::string& profile) {
  return IccReader::open(profile, stored.channels.size() == 1).map([&](const IccReader& icc) {
    XyzPicture picture;
    picture.image = make_image(stored.width, stored.height, {"X", "Y", "Z"});
    icc.to_xyz(stored.pixels, picture.image.pixels);
    picture.what = "the ICC profile " + quoted(icc.name());
    return picture;
  });
}

Result<XyzPicture> by_chunks(const PngPicture& png) {
  const Result<PngEncoding> encoding = png_encoding(png);
  if (!encoding) return tl::unexpected<Problem>(encoding.error());
  return by_encoding(png.image, *encoding).map([&](Image&& xyz) {
    XyzPicture picture;
    picture.image = std::move(xyz);
    picture.what = encoding->what;
    picture.notes = encoding->notes;
    return picture;
  });
}

}  // namespace

Result<XyzPicture> read_png_xyz(const PictureSource& source, PngAlpha use) {
  Result<PngPicture> png = read_png(source);
  if (!png) return tl::unexpected<Problem>(png.error());
  std::vector<float> alpha;
  if (png->image.channels.back() == "A") alpha = take_alpha(png->image);
  Result<XyzPicture> picture = goes_by_icc(*png) && !png->icc_profile.empty()
                                   ? by_profile(png->image, png->icc_profile)
                                   : by_chunks(*png);
  if (!picture || alpha.empty()) return picture;
  if (use == PngAlpha::aside) {
    picture->notes.emplace_back("its alpha counts where `alpha` names the file");
    return picture;
  }
  // Colours of a PNG are not multiplied by alpha, those of an EXR are: over black they agree.
  for (std::size_t i = 0; i < picture->image.pixels.size(); ++i)
    picture->image.pixels[i] *= alpha[i / 3];
  picture->notes.push_back(alpha_text(alpha));
  return picture;
}

}  // namespace metamer
