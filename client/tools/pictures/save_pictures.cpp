#include "client/tools/pictures/save_pictures.h"

#include <unistd.h>

#include <google/protobuf/text_format.h>
#include <tbb/parallel_for.h>
#include <cerrno>
#include <cstring>

#include <cassert>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "client/relight/relight.h"
#include "common/image/spectral_exr.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;
using Metadata = std::map<std::string, std::string>;

Metadata metadata_of(const Pictures& pictures) {
  Metadata metadata = pictures.metadata;
  metadata["metamer:version"] = METAMER_VERSION;
  google::protobuf::TextFormat::PrintToString(pictures.plan, &metadata["metamer:plan"]);
  return metadata;
}

Result<void> write_spectra(const Pictures& pictures, const Wavelengths& wavelengths,
                           const std::string& file) {
  const std::size_t values = wavelengths.size() * pictures.xyz.pixels.size() / 3;
  if (values > max_image_values)
    return tl::unexpected(Problem{.field = {},
                                  .file = file,
                                  .message = "a spectral picture of " + std::to_string(values) +
                                             " values is over the limit of " +
                                             std::to_string(max_image_values) +
                                             ": fewer wavelengths, or a smaller one"});
  Image bands = relight_spectral(*pictures.factors, *pictures.scene,
                                 observer_of(pictures.plan, *pictures.scene), wavelengths);
  return write_spectral_exr({.width = bands.width,
                             .height = bands.height,
                             .reflectance = false,
                             .nm = wavelengths.nm(),
                             .values = std::move(bands.pixels),
                             .units = {},
                             .polarised = false},
                            pictures.xyz, file, metadata_of(pictures));
}

std::vector<SeenLight> mis_seen_lights(const Pictures& pictures, const Wavelengths& wavelengths) {
  constexpr double unnoticed = 0.02;
  std::vector<SeenLight> lights;
  for (const v1::SceneFactors::Light& light : pictures.scene->light()) {
    const double share =
        seen_share(light, observer_of(pictures.plan, *pictures.scene), wavelengths);
    if (std::abs(share - 1) > unnoticed) lights.push_back({light.name(), share});
  }
  return lights;
}

}  // namespace

std::string lower_extension(const std::string& file) {
  std::string extension = fs::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool is_exr(const std::string& file) { return lower_extension(file) == ".exr"; }

std::string objection(const std::string& file, FileContent content) {
  const std::string extension = lower_extension(file);
  const bool factors = content == FileContent::factors;
  if (factors && extension != ".factors") return "\"" + file + "\" does not end in .factors";
  if (!factors && extension != ".png" && extension != ".exr")
    return "\"" + file + "\" ends neither in .png nor in .exr";
  std::error_code error;
  if (fs::is_directory(file, error)) return "\"" + file + "\" is a folder";
  const fs::path folder = fs::path(file).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error))
    return "there is no folder \"" + folder.string() + "\"";
  if (access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
    return "the folder of \"" + file + "\" can't be written: " + std::strerror(errno);
  return {};
}

Result<SavedPicture> save_picture(const Pictures& pictures, const std::string& file,
                                  const ExrContent& exr, const PlannedDeveloping& planned) {
  SavedPicture saved;
  saved.spectral = is_exr(file) && exr.spectral;
  if (saved.spectral) {
    assert(pictures.factors && pictures.scene);
    if (auto written = write_spectra(pictures, *exr.spectral, file); !written)
      return tl::unexpected(std::move(written.error()));
    saved.mis_seen = mis_seen_lights(pictures, *exr.spectral);
    return saved;
  }
  return write_image(pictures.xyz, file, is_exr(file) && exr.xyz, metadata_of(pictures),
                     planned.developing)
      .map([&](const GamutReport& clipped) {
        if (!is_exr(file)) saved.clipped = clipped;
        return saved;
      });
}

std::vector<std::vector<Result<SavedPicture>>> save_all(const std::vector<PictureFiles>& all,
                                                        const ExrContent& exr) {
  std::vector<std::vector<Result<SavedPicture>>> saved(all.size());
  const auto save = [&](std::size_t i) {
    for (const std::string& file : all[i].files)
      saved[i].push_back(save_picture(all[i].pictures, file, exr, all[i].planned));
  };
  if (exr.spectral)
    for (std::size_t i = 0; i < all.size(); ++i) save(i);
  else
    tbb::parallel_for(std::size_t{0}, all.size(), save);
  return saved;
}

}  // namespace metamer::client
