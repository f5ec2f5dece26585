#include "common/image/file_formats.h"

#include <dlfcn.h>

#include <algorithm>
#include <utility>

#include "common/image/picture_file.h"
#include "common/image/read_exr.h"

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
    return problem(std::string("can't load what reads a .png and draws legends: ") + dlerror());
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

/// All channels of a file's first part, R, G, B and A first.
Result<Image> read_first_part(const std::filesystem::path& file) {
  const auto parts = read_exr_parts(file);
  if (!parts) return tl::unexpected<Problem>(parts.error());
  std::vector<std::string> names;
  for (const ExrChannel& channel : parts->front().channels) names.push_back(channel.name);
  std::stable_sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    const std::string first = "RGBA";
    const auto rank = [&](const std::string& name) {
      return name.size() == 1 ? std::min(first.find(name), first.size()) : first.size();
    };
    return rank(a) < rank(b);
  });
  return read_exr(file, *parts, 0, names);
}

}  // namespace

Result<void> load_file_formats() {
  if (!formats()) return tl::unexpected(formats().error());
  return {};
}

Result<ImageHeader> read_header(const std::filesystem::path& file) {
  return call(&FileFormats::read_png_header, file);
}

Result<Image> read_image(const std::filesystem::path& file) {
  if (const auto good = check_readable(file); !good) return tl::unexpected<Problem>(good.error());
  return format_of(file) == "exr" ? read_first_part(file) : call(&FileFormats::read_png, file);
}

Result<Image> false_color(const Difference& difference, Metric metric, double top,
                          std::string_view title) {
  return call(&FileFormats::false_color, difference, metric, top, title);
}

}  // namespace metamer
