#include "common/image/oiio.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <mutex>

namespace metamer::oiio {

void stay_in_this_thread() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
  });
}

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

}  // namespace metamer::oiio
