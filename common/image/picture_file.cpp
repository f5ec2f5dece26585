#include "common/image/picture_file.h"

#include <algorithm>

namespace metamer {

std::string format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (extension == ".png") return "png";
  if (extension == ".exr") return "exr";
  return {};
}

tl::unexpected<Problem> file_problem(const std::filesystem::path& file, std::string message) {
  return tl::unexpected<Problem>(
      {.field = {}, .file = file.string(), .message = std::move(message)});
}

}  // namespace metamer
