#include "common/image/picture_file.h"

#include <algorithm>

#include "common/image/image.h"

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

std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "no reason given" : line;
}

Result<void> check_readable(const std::filesystem::path& file) {
  if (format_of(file).empty())
    return file_problem(
        file, "pictures are read from .png or .exr, not from " + quoted(file.extension().string()));
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return file_problem(file, "no such file");
  return {};
}

Result<void> check_size(const std::filesystem::path& file, int width, int height,
                        std::size_t channels) {
  if (width <= 0 || height <= 0 || channels == 0)
    return file_problem(file, "the picture has no pixels");
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (pixels > max_image_values / channels)
    return file_problem(file, "the picture is too large: " + std::to_string(width) + " × " +
                                  std::to_string(height) + " × " + std::to_string(channels) +
                                  " values, at most " + std::to_string(max_image_values));
  return {};
}

}  // namespace metamer
