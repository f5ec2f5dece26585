#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "common/mesh/gltf/document.h"
#include "common/mesh/gltf/gltf_scene.h"

namespace metamer::gltf {

/// The pictures that materials name, each image once.
class Pictures {
 public:
  /// Both must outlive it.
  Pictures(Document& document, std::vector<GltfImage>& images)
      : document_(document), images_(images) {}

  /// Of a textureInfo (3.8.2; KHR_texture_transform), as it lies on UVs whose v rises. Nothing:
  /// there is none, its image is of a kind that an extension brings, or it goes by other UVs than
  /// the first.
  std::optional<GltfPicture> of(const Value& info);

 private:
  std::size_t image(std::size_t index);

  Document& document_;
  std::vector<GltfImage>& images_;
  std::map<std::size_t, std::size_t> known_;
  std::uint64_t embedded_ = 0;  ///< Bytes, of all images.
};

}  // namespace metamer::gltf
