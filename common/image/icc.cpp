#include "common/image/icc.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "common/color/adaptation.h"

namespace metamer {
namespace {

/// ICC.1:2010, 7.2.16: the white of every profile.
constexpr Xyz d50 = {0.9642, 1.0, 0.8249};

void add_u16(std::string& to, std::uint32_t number) {
  to += static_cast<char>(number >> 8 & 0xFF);
  to += static_cast<char>(number & 0xFF);
}

void add_u32(std::string& to, std::uint32_t number) {
  add_u16(to, number >> 16);
  add_u16(to, number & 0xFFFF);
}

/// s15Fixed16Number, 4.6.
void add_fixed(std::string& to, double number) {
  add_u32(to, static_cast<std::uint32_t>(static_cast<std::int32_t>(std::lround(number * 65536))));
}

/// An element begins with its type and four zeros.
std::string element(const char* type) { return std::string(type) + std::string(4, '\0'); }

/// multiLocalizedUnicodeType, 10.13; plain letters only.
std::string text(const std::string& words) {
  std::string result = element("mluc");
  add_u32(result, 1);
  add_u32(result, 12);
  result += "enUS";
  add_u32(result, static_cast<std::uint32_t>(2 * words.size()));
  add_u32(result, 28);
  for (const char c : words) add_u16(result, static_cast<unsigned char>(c));
  return result;
}

std::string xyz(const Xyz& value) {
  std::string result = element("XYZ ");
  for (const double number : value) add_fixed(result, number);
  return result;
}

std::string matrix(const Matrix3& value) {
  std::string result = element("sf32");
  for (const auto& row : value)
    for (const double number : row) add_fixed(result, number);
  return result;
}

/// parametricCurveType, 10.15, the function of type 3: encoded → linear.
std::string curve(const Transfer& t) {
  std::string result = element("para");
  add_u16(result, 3);
  add_u16(result, 0);
  for (const double number :
       {t.gamma, 1 / (1 + t.offset), t.offset / (1 + t.offset), 1 / t.slope, t.slope * t.knee})
    add_fixed(result, number);
  return result;
}

/// The first 128 bytes, 7.2.
std::string header(std::uint32_t size) {
  std::string result;
  add_u32(result, size);
  result += std::string(4, '\0');  // no preferred module
  add_u32(result, 0x04300000);     // version 4.3
  result += "mntrRGB XYZ ";
  for (const std::uint32_t part : {2026U, 1U, 1U, 0U, 0U, 0U}) add_u16(result, part);
  result += "acsp";
  result += std::string(28, '\0');  // platform, flags, maker, model, attributes, intent
  for (const double number : d50) add_fixed(result, number);
  result.resize(128, '\0');
  return result;
}

}  // namespace

std::string icc_profile(const RgbSpace& space, bool linear) {
  // The primaries as they look under D50. A space whose white no cone responds to stays unadapted.
  const Matrix3 adapted =
      adaptation_matrix(Adaptation::bradford, white_xyz(space.primaries.white), d50)
          .value_or(identity3);
  const Matrix3 columns = multiply(adapted, space.to_xyz);
  const auto primary = [&](std::size_t c) {
    return xyz({columns[0][c], columns[1][c], columns[2][c]});
  };
  const std::string transfer = curve(linear ? Transfer{} : space.transfer);
  const std::vector<std::pair<const char*, std::string>> elements = {
      {"desc", text(space.name + (linear ? ", linear" : ""))},
      {"cprt", text("No copyright: facts about a colour space")},
      {"wtpt", xyz(d50)},
      {"chad", matrix(adapted)},
      {"rXYZ", primary(0)},
      {"gXYZ", primary(1)},
      {"bXYZ", primary(2)},
      {"rTRC", transfer},
      {"gTRC", transfer},
      {"bTRC", transfer}};

  // A table of the elements, then each at a multiple of four bytes.
  const std::size_t begin = 128 + 4 + 12 * elements.size();
  std::string table, data;
  add_u32(table, static_cast<std::uint32_t>(elements.size()));
  for (const auto& [name, bytes] : elements) {
    table += name;
    add_u32(table, static_cast<std::uint32_t>(begin + data.size()));
    add_u32(table, static_cast<std::uint32_t>(bytes.size()));
    data += bytes;
    data.resize((data.size() + 3) / 4 * 4, '\0');
  }
  return header(static_cast<std::uint32_t>(begin + data.size())) + table + data;
}

}  // namespace metamer
