#include "common/mesh/gltf/pictures.h"

#include <cmath>
#include <numbers>

#include "common/mesh/gltf/nodes.h"

namespace metamer::gltf {
namespace {

/// glTF 2.0, 5.26.4: OpenGL's numbers.
GltfPicture::Wrap wrap_of(const Value& mode) {
  constexpr std::uint64_t clamp = 33071, mirror = 33648, repeat = 10497;
  const std::uint64_t number = mode.whole(1u << 16, repeat);
  return number == clamp    ? GltfPicture::Wrap::clamp
         : number == mirror ? GltfPicture::Wrap::mirror
                            : GltfPicture::Wrap::repeat;
}

std::array<double, 2> pair_of(const Value& list, double otherwise) {
  const auto numbers = list.numbers(2);
  return numbers ? std::array{(*numbers)[0], (*numbers)[1]} : std::array{otherwise, otherwise};
}

/// The extension turns UVs counter-clockwise as they are seen, v going down: u' = c su u + s sv v +
/// ou, v' = −s su u + c sv v + ov. With v and v' rising, 1 − v:
void place(const Value& transform, GltfPicture& picture) {
  const auto [ou, ov] = pair_of(transform["offset"], 0);
  picture.scale = pair_of(transform["scale"], 1);
  const double angle = transform["rotation"].number(0), c = std::cos(angle), s = std::sin(angle);
  picture.rotation = angle * 180 / std::numbers::pi;
  picture.offset = {ou + s * picture.scale[1], 1 - ov - c * picture.scale[1]};
}

}  // namespace

std::optional<GltfPicture> Pictures::of(const Value& info) {
  if (!info) return std::nullopt;
  const Value root = document_.root(), textures = root["textures"];
  const auto index = info["index"].index(textures.size());
  if (!index) return std::nullopt;
  const Value texture = textures[*index], transform = info["extensions"]["KHR_texture_transform"];
  const auto source = texture["source"].index(root["images"].size());
  const std::uint64_t set =
      transform["texCoord"].whole(1u << 16, info["texCoord"].whole(1u << 16, 0));
  if (!source) return std::nullopt;
  GltfPicture picture{
      .image = image(*source), .strength = info["scale"].number(1), .coordinate_set = set};
  if (const auto sampler = texture["sampler"].index(root["samplers"].size())) {
    picture.wrap_u = wrap_of(root["samplers"][*sampler]["wrapS"]);
    picture.wrap_v = wrap_of(root["samplers"][*sampler]["wrapT"]);
  }
  if (transform) place(transform, picture);
  return picture;
}

std::size_t Pictures::image(std::size_t index) {
  const auto [known, is_new] = known_.try_emplace(index, images_.size());
  if (!is_new) return known->second;
  const Value value = document_.root()["images"][index];
  GltfImage& to = images_.emplace_back(GltfImage{.name = on_one_line(value["name"].text())});
  auto place = document_.image(value);
  if (!place) {
    to.fault = place.error().message;
    return known->second;
  }
  to.file = std::move(place->file);
  to.bytes = std::move(place->bytes);
  // Views may overlap: a small file could ask for a full disk.
  embedded_ += to.bytes.size();
  if (embedded_ > document_.size()) {
    to.bytes = {};
    to.fault = "its images have more bytes together than the file";
  }
  return known->second;
}

}  // namespace metamer::gltf
