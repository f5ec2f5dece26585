#include "client/tools/pictures/picture_layers.h"

#include "client/tools/pictures/save_pictures.h"

namespace metamer::client {

std::vector<PictureLayer> picture_layers(const std::filesystem::path& file) {
  if (!is_exr(file.string())) return {};
  const auto parts = read_exr_parts(file);
  if (!parts) return {};
  std::vector<PictureLayer> layers;
  for (const ExrLayer& layer : find_layers(*parts)) {
    PictureLayer one{.name = name_of(layer, *parts), .choice = {.part = {}, .layer = layer.layer}};
    if (parts->size() > 1) one.choice.part = (*parts)[layer.part].name;
    if (one.name.empty()) one.name = "without a layer";
    layers.push_back(std::move(one));
  }
  if (layers.size() < 2) layers.clear();
  return layers;
}

}  // namespace metamer::client
