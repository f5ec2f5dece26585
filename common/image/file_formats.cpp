#include "common/image/file_formats.h"

#include <dlfcn.h>

#include <utility>

#include "common/image/exr.h"
#include "common/image/picture_file.h"

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

/// Says why nothing can be there to be read; empty: nothing speaks against it.
std::string objection(const std::filesystem::path& file) {
  if (format_of(file).empty())
    return "pictures are read from .png or .exr, not from " + quoted(file.extension().string());
  std::error_code error;
  return std::filesystem::exists(file, error) ? "" : "no such file";
}

}  // namespace

Result<void> load_file_formats() {
  if (!formats()) return tl::unexpected(formats().error());
  return {};
}

Result<ImageHeader> read_header(const std::filesystem::path& file) {
  if (const std::string wrong = objection(file); !wrong.empty()) return file_problem(file, wrong);
  return format_of(file) == "exr" ? read_exr_header(file)
                                  : call(&FileFormats::read_png_header, file);
}

Result<Image> read_image(const std::filesystem::path& file) {
  if (const std::string wrong = objection(file); !wrong.empty()) return file_problem(file, wrong);
  return format_of(file) == "exr" ? read_exr(file) : call(&FileFormats::read_png, file);
}

Result<Image> false_color(const Difference& difference, Metric metric, double top,
                          std::string_view title) {
  return call(&FileFormats::false_color, difference, metric, top, title);
}

}  // namespace metamer
