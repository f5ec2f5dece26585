#include "common/color/rgb_space.h"

#include <cassert>
#include <cmath>

#include "common/color/adaptation.h"

namespace metamer {
namespace {

// Beyond, a space is a mistake, and its matrices have no digits left.
constexpr double largest_coordinate = 10;
constexpr double smallest_area = 1e-6;

constexpr Chromaticity d65 = {0.3127, 0.3290};

/// The primaries as columns, each scaled so that R = G = B = 1 gives the white.
Matrix3 derive(const Primaries& primaries) {
  Matrix3 columns{};
  std::size_t column = 0;
  for (const Chromaticity& primary : {primaries.red, primaries.green, primaries.blue}) {
    const Xyz xyz = white_xyz(primary);
    for (std::size_t row = 0; row < 3; ++row) columns[row][column] = xyz[row];
    ++column;
  }
  const Vector3 scale = multiply(invert(columns), white_xyz(primaries.white));
  for (auto& row : columns)
    for (std::size_t c = 0; c < 3; ++c) row[c] *= scale[c];
  return columns;
}

/// Twice the area of a triangle, negative where it turns clockwise.
double area(const Chromaticity& a, const Chromaticity& b, const Chromaticity& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

Result<void> check(const Primaries& primaries) {
  const std::pair<const char*, Chromaticity> named[] = {{"red", primaries.red},
                                                        {"green", primaries.green},
                                                        {"blue", primaries.blue},
                                                        {"white", primaries.white}};
  for (const auto& [name, c] : named) {
    for (const double value : {c.x, c.y})
      if (!(std::abs(value) <= largest_coordinate))
        return problem(std::string(name) + " must have x and y in -10..10 (one is " +
                       number_text(value) + ")");
    if (c.y == 0 || (c.y < 0 && std::string_view(name) == "white"))
      return problem(std::string(name) + " must have a y " +
                     (std::string_view(name) == "white" ? "above 0" : "other than 0") + " (it is " +
                     number_text(c.y) + ")");
  }

  const double whole = area(primaries.red, primaries.green, primaries.blue);
  if (std::abs(whole) < smallest_area) return problem("red, green and blue must not lie on a line");
  for (const double part : {area(primaries.white, primaries.green, primaries.blue),
                            area(primaries.red, primaries.white, primaries.blue),
                            area(primaries.red, primaries.green, primaries.white)})
    if (part / whole < smallest_area)
      return problem("white must lie inside the triangle of red, green and blue");
  return {};
}

RgbSpace standard(const char* word, const char* name, const Primaries& primaries,
                  const Transfer& transfer) {
  return *make_rgb_space(word, name, primaries, transfer);
}

/// In the order of StandardSpace.
const std::vector<RgbSpace>& standard_spaces() {
  // IEC 61966-2-1; SMPTE EG 432-1 has no white of D65, Display P3 takes it and sRGB's curve.
  static constexpr Transfer srgb = {
      .gamma = 2.4, .offset = 0.055, .slope = 12.92, .knee = 0.0031308};
  // ITU-R BT.2020-2, table 4: α and β such that line and power meet with one slope.
  static constexpr Transfer bt_2020 = {
      .gamma = 1 / 0.45, .offset = 0.09929682680944, .slope = 4.5, .knee = 0.018053968510807};
  static const std::vector<RgbSpace> spaces = {
      standard("srgb", "sRGB", {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, d65}, srgb),
      standard("display-p3", "Display P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, d65},
               srgb),
      // Adobe RGB (1998) Color Image Encoding, 4.3.1.
      standard("adobe-rgb", "Adobe RGB (1998)", {{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, d65},
               {.gamma = 563.0 / 256}),
      // ISO 22028-2 (ROMM RGB): the white is D50.
      standard("prophoto", "ProPhoto RGB",
               {{0.7347, 0.2653}, {0.1596, 0.8404}, {0.0366, 0.0001}, {0.3457, 0.3585}},
               {.gamma = 1.8, .offset = 0, .slope = 16, .knee = 1.0 / 512}),
      standard("rec-2020", "Rec. 2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, d65},
               bt_2020),
      // E[3.1-16]: 700, 546.1 and 435.8 nm, white of equal energy. It knows no encoding.
      standard("cie-rgb", "CIE RGB",
               {{0.49000 / 0.66697, 0.17697 / 0.66697},
                {0.31000 / 1.13240, 0.81240 / 1.13240},
                {0.20000 / 1.20063, 0.01063 / 1.20063},
                {1.0 / 3, 1.0 / 3}},
               {}),
  };
  return spaces;
}

}  // namespace

double encode(const Transfer& t, double linear) {
  const double size = std::abs(linear);
  const double encoded =
      size <= t.knee ? t.slope * size : (1 + t.offset) * std::pow(size, 1 / t.gamma) - t.offset;
  return std::copysign(encoded, linear);
}

double decode(const Transfer& t, double encoded) {
  const double size = std::abs(encoded);
  const double linear = size <= t.slope * t.knee
                            ? size / t.slope
                            : std::pow((size + t.offset) / (1 + t.offset), t.gamma);
  return std::copysign(linear, encoded);
}

Xyz white_xyz(const Chromaticity& c) { return {c.x / c.y, 1.0, (1 - c.x - c.y) / c.y}; }

Result<RgbSpace> make_rgb_space(std::string word, std::string name, const Primaries& primaries,
                                const Transfer& transfer) {
  if (auto checked = check(primaries); !checked) return tl::unexpected(std::move(checked.error()));
  if (!(transfer.gamma > 0) || !std::isfinite(transfer.gamma))
    return problem("gamma must be above 0 (it is " + number_text(transfer.gamma) + ")");
  const Matrix3 to_xyz = derive(primaries);
  return RgbSpace{.word = std::move(word),
                  .name = std::move(name),
                  .primaries = primaries,
                  .transfer = transfer,
                  .to_xyz = to_xyz,
                  .from_xyz = invert(to_xyz)};
}

Result<Matrix3> white_for_d65(const RgbSpace& space) {
  constexpr double alike = 5e-4;
  const Chromaticity& white = space.primaries.white;
  if (std::abs(white.x - d65.x) < alike && std::abs(white.y - d65.y) < alike) return identity3;
  return adaptation_matrix(Adaptation::bradford, white_xyz(d65), white_xyz(white));
}

const RgbSpace& rgb_space(StandardSpace space) {
  return standard_spaces()[static_cast<std::size_t>(space)];
}

const RgbSpace* find_rgb_space(std::string_view word) {
  for (const RgbSpace& space : standard_spaces())
    if (space.word == word) return &space;
  return nullptr;
}

std::vector<std::string> rgb_space_words() {
  std::vector<std::string> words;
  for (const RgbSpace& space : standard_spaces()) words.push_back(space.word);
  return words;
}

}  // namespace metamer
