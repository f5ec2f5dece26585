#include <algorithm>

#include "common/image/image.h"
#include "common/image/picture_file.h"
#include "common/image/read_exr.h"
#include "common/image/read_png.h"

namespace metamer {
namespace {

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

Result<Image> read_image(const std::filesystem::path& file) {
  if (const auto good = check_readable(file); !good) return tl::unexpected<Problem>(good.error());
  if (format_of(file) == "exr") return read_first_part(file);
  return read_png(file).map([](PngPicture&& png) { return std::move(png.image); });
}

}  // namespace metamer
