#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/mesh/gltf/gltf_scene.h"
#include "metamer/v1/texture.pb.h"

namespace metamer::client {

/// A file that a scene needs beside it.
struct NewFile {
  std::string name;  ///< Relative to the scene's folder.
  Bytes bytes;
};

/// The images of a glTF as files that a scene can name. A PNG beside the mesh stays where it is;
/// one within the file, and every JPEG, becomes a new PNG beside the scene.
class ImportedPictures {
 public:
  /// `mesh`: of the glTF, relative to `folder`, the scene's. `gltf` must outlive it.
  ImportedPictures(const GltfScene& gltf, std::string mesh, std::filesystem::path folder);

  struct Picture {
    std::string file;  ///< Relative to the scene's folder.
    bool has_colors = false, has_alpha = false;
  };
  /// Of a surface whose every corner `has_uvs`. Errors: what keeps the image from being one, or
  /// from lying there, as a sentence about it.
  Result<Picture> picture(const GltfPicture& where, bool has_uvs);

  /// Those that have to be written, of what was asked for.
  std::vector<NewFile> take_files() { return std::move(files_); }

 private:
  Result<Picture> find(const GltfImage& image);
  std::string new_name(const GltfImage& image, const std::string& beside);

  const GltfScene& gltf_;
  std::string mesh_;
  std::filesystem::path folder_;
  std::map<std::size_t, Result<Picture>> known_;
  std::vector<NewFile> files_;
};

/// Where a picture lies, as a scene has it. Returns what of it is left out: ", and …", or nothing.
template <class Message>
std::string place(const GltfPicture& picture, Message& to) {
  if (picture.wrap_u != GltfPicture::Wrap::repeat)
    to.set_wrap(picture.wrap_u == GltfPicture::Wrap::clamp ? v1::Texture::CLAMP
                                                           : v1::Texture::MIRROR);
  if (picture.scale != std::array{1.0, 1.0}) {
    to.mutable_scale()->set_u(picture.scale[0]);
    to.mutable_scale()->set_v(picture.scale[1]);
  }
  if (picture.offset != std::array{0.0, 0.0}) {
    to.mutable_offset()->set_u(picture.offset[0]);
    to.mutable_offset()->set_v(picture.offset[1]);
  }
  if (picture.rotation != 0) to.set_rotation(picture.rotation);
  return picture.wrap_u == picture.wrap_v ? "" : ", and its wrapT is taken as its wrapS";
}

}  // namespace metamer::client
