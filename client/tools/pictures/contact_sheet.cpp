#include "client/tools/pictures/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "client/tools/text/formatted.h"
#include "common/color/srgb.h"
#include "common/image/labels.h"
#include "common/image/ramp.h"

namespace metamer::client {
namespace {

constexpr int gap = 12, line = label_height + 7;
constexpr int bar_height = 14, legend_height = 2 * line + bar_height + gap;
constexpr double ground_y = 0.02;
constexpr float ink = 0.85F, faint_ink = 0.55F;

/// A pixel of a picture that was made smaller: the mean of those that are there.
void mean_of(const Image& image, int left, int top, int side, float* to) {
  const int right = std::min(left + side, image.width), end = std::min(top + side, image.height);
  const double count = static_cast<double>(right - left) * (end - top);
  for (std::size_t c = 0; c < image.channels.size(); ++c) {
    double sum = 0;
    for (int y = top; y < end; ++y)
      for (int x = left; x < right; ++x) sum += static_cast<double>(image.at(x, y)[c]);
    to[c] = static_cast<float>(sum / count);
  }
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

void set(Image& image, int x, int y, const Rgb& encoded) {
  Rgb linear{};
  std::transform(encoded.begin(), encoded.end(), linear.begin(), srgb::decode);
  const Xyz xyz = srgb::to_xyz(linear);
  for (std::size_t c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(xyz[c]);
}

void place_map(const Image& map, double scale, int left, int top, Image& sheet) {
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      set(sheet, left + x, top + y, ramp_color(static_cast<double>(*map.at(x, y)), scale));
}

std::string difference_text(const SheetCell& cell, bool is_reference) {
  if (!cell.title.empty()) return cell.note;
  if (is_reference) return {};
  if (!cell.difference) return "no dE00: the light is dark";
  if (cell.difference->count == 0) return "no pixel differs";
  return formatted("dE00 mean %.2f, max %.2f", cell.difference->mean, cell.difference->maximum);
}

/// Where what is, in pixels.
struct Layout {
  /// Error: it is too large.
  static Result<Layout> of(const Sheet& sheet) {
    Layout layout;
    for (const SheetCell& cell : sheet.cells) {
      layout.picture_width = std::max(layout.picture_width, cell.picture.width);
      layout.picture_height = std::max(layout.picture_height, cell.picture.height);
    }
    layout.map_height = sheet.maps ? layout.picture_height + gap / 2 : 0;
    const std::size_t columns = sheet.lights.size(), rows = sheet.candidates.size();
    const double width = static_cast<double>(columns) * (layout.picture_width + gap) + gap;
    const double height = static_cast<double>(rows) * layout.row_height(1) + line + gap +
                          (sheet.maps ? legend_height : 0);
    if (width * height * 3 > static_cast<double>(max_image_values))
      return problem(formatted("a sheet of %zu by %zu pictures is too large", columns, rows));
    layout.width = layout.left(columns);
    layout.height = layout.top(rows) + (sheet.maps ? legend_height : 0);
    return layout;
  }

  int left(std::size_t column) const {
    return gap + static_cast<int>(column) * (picture_width + gap);
  }
  int top(std::size_t row) const {
    const int below = row == 0 ? 0 : row_height(0) + static_cast<int>(row - 1) * row_height(1);
    return line + gap + below;
  }
  /// The reference has no map.
  int row_height(std::size_t row) const {
    return picture_height + (row == 0 ? 0 : map_height) + 2 * line + gap;
  }

  int picture_width = 0, picture_height = 0;
  int map_height = 0;  ///< With the gap above it; 0: there are none.
  int width = 0, height = 0;
};

/// The end of the maps' scale.
double scale_of(const Sheet& sheet) {
  double largest = 0;
  for (const SheetCell& cell : sheet.cells)
    if (cell.difference) largest = std::max(largest, cell.difference->percentile_99);
  return scale_end(largest);
}

/// The scale with its numbers below it, and above it what it is of.
void add_legend(const Sheet& sheet, const Layout& layout, double scale, Image& image,
                std::vector<Label>& labels) {
  const int from = gap, to = from + std::min(layout.width - 2 * gap, sheet_width);
  const int top = layout.height - legend_height + gap / 2;
  const int bar = top + line, numbers = bar + bar_height + label_height + 5;
  for (int x = from; x < to; ++x)
    for (int y = bar; y < bar + bar_height; ++y)
      set(image, x, y, cubehelix(static_cast<double>(x - from) / (to - from - 1)));
  labels.push_back({.x = from,
                    .y = top + label_height,
                    .words = "dE00 from " + sheet.candidates.front(),
                    .width = layout.width - 2 * gap,
                    .grey = ink});
  const auto number = [&](int x, const std::string& words, Label::Place place) {
    labels.push_back({.x = x, .y = numbers, .words = words, .place = place, .grey = ink});
  };
  number(from, "0", Label::Place::left);
  number((from + to) / 2, number_text(scale / 2), Label::Place::center);
  number(to, number_text(scale) + " or more", Label::Place::right);
}

}  // namespace

void set_difference(const Difference& difference, SheetCell& cell) {
  // Other paint has other bands (common/transport/scene_bands), which move every pixel by 1e-6.
  constexpr double rounding = 0.005;
  std::vector<double> differing;
  for (const double value : difference.values)
    if (!(value < rounding)) differing.push_back(value);
  cell.difference = error_statistics(differing);
  cell.share = static_cast<double>(differing.size()) /
               static_cast<double>(std::max<std::size_t>(1, difference.values.size()));
}

Image for_sheet(const Image& picture) {
  const int down = (picture.width + sheet_width - 1) / sheet_width;
  const int up = down > 1 ? 1 : sheet_width / picture.width;
  const auto size = [&](int n) { return (n + down - 1) / down * up; };
  Image made = make_image(size(picture.width), size(picture.height), picture.channels);
  for (int y = 0; y < made.height; ++y)
    for (int x = 0; x < made.width; ++x)
      mean_of(picture, x / up * down, y / up * down, down, made.at(x, y));
  return made;
}

Image map_for_sheet(const Difference& difference) {
  Image map = make_image(difference.width, difference.height, {"dE00"});
  std::transform(difference.values.begin(), difference.values.end(), map.pixels.begin(),
                 [](double value) { return static_cast<float>(value); });
  return for_sheet(map);
}

Result<Image> contact_sheet(const Sheet& sheet) {
  const auto made = Layout::of(sheet);
  if (!made) return tl::unexpected<Problem>(made.error());
  const Layout& layout = *made;
  const double scale = scale_of(sheet);
  Image image = ground(layout.width, layout.height);
  std::vector<Label> labels;
  for (std::size_t i = 0; i < sheet.cells.size(); ++i) {
    const std::size_t r = i / sheet.lights.size(), c = i % sheet.lights.size();
    const SheetCell& cell = sheet.cells[i];
    const int left = layout.left(c), top = layout.top(r);
    const auto label = [&](int below, const std::string& words, float grey) {
      labels.push_back({.x = left,
                        .y = top + below,
                        .words = words,
                        .width = layout.picture_width,
                        .grey = grey});
    };
    if (r == 0) label(-gap / 2, sheet.lights[c], ink);
    if (cell.title.empty())
      label(label_height, sheet.candidates[r], c == 0 ? ink : faint_ink);
    else
      label(label_height, cell.title, ink);
    if (!cell.picture.pixels.empty()) place(cell.picture, left, top + line, image);
    if (!cell.map.pixels.empty() && sheet.maps)
      place_map(cell.map, scale, left, top + line + layout.map_height, image);
    label(layout.row_height(r) - gap - line + label_height + 3, difference_text(cell, r == 0), ink);
  }
  if (sheet.maps) add_legend(sheet, layout, scale, image, labels);
  if (auto drawn = draw_labels(image, labels); !drawn)
    return tl::unexpected(std::move(drawn.error()));
  return image;
}

Result<Image> picture_grid(std::vector<SheetCell> cells) {
  Sheet sheet;
  const auto drawn = std::find_if(cells.begin(), cells.end(), [](const SheetCell& cell) {
    return !cell.picture.pixels.empty();
  });
  if (drawn == cells.end()) return problem("a sheet without a picture");
  const double shape = static_cast<double>(drawn->picture.height) / drawn->picture.width;
  const auto count = static_cast<double>(cells.size());
  const auto columns = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::lround(std::ceil(std::sqrt(count * shape)))), 1, cells.size());
  sheet.lights.resize(columns);
  sheet.candidates.resize((cells.size() + columns - 1) / columns);
  sheet.cells = std::move(cells);
  return contact_sheet(sheet);
}

}  // namespace metamer::client
