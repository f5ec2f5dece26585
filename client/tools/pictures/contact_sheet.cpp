#include "client/tools/pictures/contact_sheet.h"

#include <algorithm>

#include "client/tools/text/formatted.h"
#include "common/color/srgb.h"
#include "common/image/labels.h"

namespace metamer::client {
namespace {

constexpr int gap = 12, line = label_height + 7;
constexpr double ground_y = 0.02;
constexpr float ink = 0.85F, faint_ink = 0.55F;

/// A pixel of a picture that was made smaller: the mean of those that are there.
void mean_of(const Image& image, int left, int top, int side, float* to) {
  const int right = std::min(left + side, image.width), end = std::min(top + side, image.height);
  double sum[3] = {};
  for (int y = top; y < end; ++y)
    for (int x = left; x < right; ++x)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<double>(image.at(x, y)[c]);
  const double count = static_cast<double>(right - left) * (end - top);
  for (std::size_t c = 0; c < 3; ++c) to[c] = static_cast<float>(sum[c] / count);
}

void place(const Image& picture, int left, int top, Image& sheet) {
  for (int y = 0; y < picture.height; ++y)
    std::copy_n(picture.at(0, y), std::size_t{3} * static_cast<std::size_t>(picture.width),
                sheet.at(left, top + y));
}

Image ground(int width, int height) {
  Image image = make_image(width, height, {"X", "Y", "Z"});
  const Xyz grey = srgb::to_xyz({ground_y, ground_y, ground_y});
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(grey[i % 3]);
  return image;
}

std::string difference_text(const SheetCell& cell, bool is_reference) {
  if (is_reference) return {};
  if (!cell.difference) return "no dE00: the light is dark";
  if (cell.difference->count == 0) return "no pixel differs";
  return formatted("dE00 mean %.2f, max %.2f", cell.difference->mean, cell.difference->maximum);
}

}  // namespace

void set_difference(const Difference& difference, SheetCell& cell) {
  std::vector<double> differing;
  for (const double value : difference.values)
    if (value != 0) differing.push_back(value);
  cell.difference = error_statistics(differing);
  cell.share = static_cast<double>(differing.size()) /
               static_cast<double>(std::max<std::size_t>(1, difference.values.size()));
}

Image for_sheet(const Image& picture) {
  const int down = (picture.width + sheet_width - 1) / sheet_width;
  const int up = down > 1 ? 1 : sheet_width / picture.width;
  const auto size = [&](int n) { return (n + down - 1) / down * up; };
  Image made = make_image(size(picture.width), size(picture.height), {"X", "Y", "Z"});
  for (int y = 0; y < made.height; ++y)
    for (int x = 0; x < made.width; ++x)
      mean_of(picture, x / up * down, y / up * down, down, made.at(x, y));
  return made;
}

Result<Image> contact_sheet(const Sheet& sheet) {
  const Image& first = sheet.cells.front().picture;
  const int column = first.width + gap, row = first.height + 2 * line + gap;
  const auto columns = sheet.lights.size(), rows = sheet.candidates.size();
  const auto length = [](std::size_t count, int pitch) {
    return static_cast<double>(count) * pitch + gap;
  };
  const double width = length(columns, column), height = length(rows, row) + line;
  if (width * height * 3 > static_cast<double>(max_image_values))
    return problem(formatted("a sheet of %zu by %zu pictures is too large", columns, rows));

  Image image = ground(static_cast<int>(width), static_cast<int>(height));
  std::vector<Label> labels;
  for (std::size_t i = 0; i < sheet.cells.size(); ++i) {
    const std::size_t r = i / columns, c = i % columns;
    const int left = gap + static_cast<int>(c) * column;
    const int top = line + gap + static_cast<int>(r) * row;
    const auto label = [&](int below, const std::string& words, float grey) {
      labels.push_back(
          {.x = left, .y = top + below, .words = words, .width = first.width, .grey = grey});
    };
    if (r == 0) label(-gap / 2, sheet.lights[c], ink);
    label(label_height, sheet.candidates[r], c == 0 ? ink : faint_ink);
    place(sheet.cells[i].picture, left, top + line, image);
    label(line + first.height + label_height + 3, difference_text(sheet.cells[i], r == 0), ink);
  }
  if (auto drawn = draw_labels(image, labels); !drawn)
    return tl::unexpected(std::move(drawn.error()));
  return image;
}

}  // namespace metamer::client
