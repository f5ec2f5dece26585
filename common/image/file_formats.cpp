#include "common/image/file_formats.h"

#include <dlfcn.h>

#include <utility>

namespace metamer {
namespace {

Result<const FileFormats*> load() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto file = program.parent_path() / "metamer-file-formats.so";
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const auto functions =
      module
          ? reinterpret_cast<decltype(&metamer_file_formats)>(dlsym(module, "metamer_file_formats"))
          : nullptr;
  if (!functions)
    return problem(std::string("can't load what reads and writes pictures: ") + dlerror());
  return functions();
}

const Result<const FileFormats*>& formats() {
  static const Result<const FileFormats*> loaded = load();
  return loaded;
}

template <class Function, class... Arguments>
auto call(Function FileFormats::*function, Arguments&&... arguments)
    -> decltype((std::declval<FileFormats>().*function)(std::forward<Arguments>(arguments)...)) {
  if (!formats()) return tl::unexpected(formats().error());
  return ((*formats())->*function)(std::forward<Arguments>(arguments)...);
}

}  // namespace

Result<void> load_file_formats() {
  if (!formats()) return tl::unexpected(formats().error());
  return {};
}

Result<GamutReport> write_image(const Image& xyz_image, const std::filesystem::path& file, bool xyz,
                                const std::map<std::string, std::string>& metadata,
                                const Developing& developing) {
  return call(&FileFormats::write_image, xyz_image, file, xyz, metadata, developing);
}

Result<void> write_rgb(int width, int height, std::span<const std::uint8_t> rgb,
                       const std::filesystem::path& file, const Developing& developing) {
  return call(&FileFormats::write_rgb, width, height, rgb, file, developing);
}

Result<ImageHeader> read_header(const std::filesystem::path& file) {
  return call(&FileFormats::read_header, file);
}

Result<Image> read_image(const std::filesystem::path& file) {
  return call(&FileFormats::read_image, file);
}

Result<void> write_spectral_exr(const SpectralImage& image, const Image& preview,
                                const std::filesystem::path& file,
                                const std::map<std::string, std::string>& metadata) {
  return call(&FileFormats::write_spectral_exr, image, preview, file, metadata);
}

Result<std::optional<SpectralImage>> read_spectral_exr(const std::filesystem::path& file) {
  return call(&FileFormats::read_spectral_exr, file);
}

Result<Image> false_color(const Difference& difference, Metric metric, double top,
                          std::string_view title) {
  return call(&FileFormats::false_color, difference, metric, top, title);
}

}  // namespace metamer
