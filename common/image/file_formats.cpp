#include "common/image/file_formats.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>

namespace metamer {
namespace {

/// Beside the program, as it is built, or in the folder that an install has for it.
std::filesystem::path module_file() {
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  const auto beside = folder / "metamer-file-formats.so";
  const auto installed = folder.parent_path() / "lib/metamer/metamer-file-formats.so";
  return !exists(beside, error) && exists(installed, error) ? installed : beside;
}

Result<const FileFormats*> load() {
  const auto file = module_file();
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const auto functions =
      module
          ? reinterpret_cast<decltype(&metamer_file_formats)>(dlsym(module, "metamer_file_formats"))
          : nullptr;
  if (!functions)
    return problem(std::string("can't load what draws legends and reads JPEGs: ") + dlerror());
  return functions();
}

const Result<const FileFormats*>& formats() {
  static const Result<const FileFormats*> loaded = load();
  return loaded;
}

}  // namespace

Result<Image> false_color(const Difference& difference, Metric metric, double top,
                          std::string_view title) {
  if (!formats()) return tl::unexpected(formats().error());
  return (*formats())->false_color(difference, metric, top, title);
}

Result<void> draw_labels(Image& image, const std::vector<Label>& labels) {
  if (!formats()) return tl::unexpected(formats().error());
  return (*formats())->draw_labels(image, labels);
}

Result<RgbBytes> decode_jpeg(std::string_view bytes, std::uint64_t most) {
  if (!formats()) return tl::unexpected(formats().error());
  return (*formats())->decode_jpeg(bytes, most);
}

}  // namespace metamer
