#include "client/tools/mesh/import_pictures.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "common/image/jpeg.h"
#include "common/image/write_png.h"
#include "common/scene/files.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;
using std::string_view_literals::operator""sv;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

bool is_png(std::string_view bytes) {
  return bytes.starts_with("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR"sv) && bytes.size() >= 33;
}
bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"); }

/// PNG (3rd edition), 11.2.1 and 11.3.1: by its colour type, or a chunk before the pixels.
ImportedPictures::Picture png_channels(std::string_view bytes) {
  const auto type = static_cast<unsigned char>(bytes[25]);
  ImportedPictures::Picture picture{{}, (type & 2) != 0, (type & 4) != 0};
  for (std::size_t at = 8; !picture.has_alpha && at + 8 <= bytes.size();) {
    const std::string_view name = bytes.substr(at + 4, 4);
    if (name == "IDAT") break;
    picture.has_alpha = name == "tRNS";
    at += std::size_t{12} + word_at(bytes, at);
  }
  return picture;
}

/// As PNG of 8 bits.
Result<Bytes> png_of_jpeg(std::string_view bytes) {
  auto decoded = decode_jpeg(bytes, limits::max_texture_weights);
  if (!decoded) return tl::unexpected(std::move(decoded.error()));
  const auto row = 3 * static_cast<std::size_t>(decoded->width);
  return encode_png(
             {.width = decoded->width, .height = decoded->height, .icc_profile = {}, .texts = {}},
             [&](int y, unsigned char* to) {
               std::copy_n(decoded->rgb.begin() +
                               static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(y)),
                           row, to);
             })
      .map([](std::vector<unsigned char>&& png) {
        return Bytes(std::vector<char>(png.begin(), png.end()));
      });
}

/// A name that every file system takes: what else stands in it becomes "_".
std::string plain(std::string name) {
  constexpr std::size_t most = 60;
  name.resize(std::min(name.size(), most));
  for (char& c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!letter && c != '-' && c != '_') c = '_';
  }
  return name;
}

}  // namespace

ImportedPictures::ImportedPictures(const GltfScene& gltf, std::string mesh, fs::path folder)
    : gltf_(gltf), mesh_(std::move(mesh)), folder_(std::move(folder)) {
  if (folder_.empty()) folder_ = ".";
}

Result<ImportedPictures::Picture> ImportedPictures::picture(const GltfPicture& where,
                                                            bool has_uvs) {
  if (where.coordinate_set != 0)
    return problem("it lies by TEXCOORD_" + std::to_string(where.coordinate_set) +
                   ", and TEXCOORD_0 alone is read");
  if (!has_uvs) return problem("not all of its surface has UVs");
  const auto known = known_.find(where.image);
  if (known != known_.end()) return known->second;
  return known_.emplace(where.image, find(gltf_.images[where.image])).first->second;
}

Result<ImportedPictures::Picture> ImportedPictures::find(const GltfImage& image) {
  if (!image.fault.empty()) return problem(image.fault);
  std::string text, file;
  std::string_view bytes(image.bytes.data(), image.bytes.size());
  if (!image.file.empty()) {
    file = (fs::path(mesh_).parent_path() / image.file).lexically_normal().generic_string();
    const auto found = find_in_folder(file, folder_, limits::max_asset, true);
    if (!found) return tl::unexpected(found.error());
    auto read = read_file(*found, limits::max_asset);
    if (!read) return tl::unexpected(std::move(read.error()));
    text = *std::move(read);
    bytes = text;
  }
  if (!is_png(bytes) && !is_jpeg(bytes)) return problem("it is neither a PNG nor a JPEG");
  if (files_.size() == limits::max_assets)
    return problem("a scene has at most " + std::to_string(limits::max_assets) + " files");

  if (is_jpeg(bytes)) {
    auto png = png_of_jpeg(bytes);
    if (!png) return tl::unexpected(std::move(png.error()));
    files_.push_back({new_name(image, file), *std::move(png)});
    return Picture{files_.back().name, true, false};
  }
  Picture picture = png_channels(bytes);
  picture.file = file;
  // A scene goes by a file's ending.
  if (!file.empty() && has_extension(file, ".png")) return picture;
  files_.push_back(
      {new_name(image, file), file.empty() ? image.bytes : Bytes({bytes.begin(), bytes.end()})});
  picture.file = files_.back().name;
  return picture;
}

/// Beside the scene; nothing else that is written is called so.
std::string ImportedPictures::new_name(const GltfImage& image, const std::string& beside) {
  std::string stem = plain(fs::path(mesh_).stem().string());
  const std::string own = plain(beside.empty() ? image.name : fs::path(beside).stem().string());
  stem += "-" + (own.empty() ? "image" : own);
  const auto is_given = [&](const std::string& name) {
    return std::any_of(files_.begin(), files_.end(),
                       [&](const NewFile& one) { return one.name == name; });
  };
  std::string name = stem + ".png";
  for (int i = 2; is_given(name); ++i) name = stem + "-" + std::to_string(i) + ".png";
  return name;
}

}  // namespace metamer::client
