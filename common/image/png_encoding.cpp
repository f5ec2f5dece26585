#include "common/image/png_encoding.h"

#include <array>
#include <cmath>

#include "common/color/srgb.h"

namespace metamer {
namespace {

/// A row of ITU-T H.273, table 2: red, green, blue, white.
struct CodedPrimaries {
  int code;
  const char* name;
  Primaries primaries;
};

constexpr Chromaticity screen_white = {0.3127, 0.3290};
constexpr std::array coded_primaries = {
    CodedPrimaries{1, "sRGB", {{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, screen_white}},
    CodedPrimaries{4, "BT.470 M", {{0.67, 0.33}, {0.21, 0.71}, {0.14, 0.08}, {0.310, 0.316}}},
    CodedPrimaries{5, "BT.470 BG", {{0.64, 0.33}, {0.29, 0.60}, {0.15, 0.06}, screen_white}},
    CodedPrimaries{6, "SMPTE 170M", {{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, screen_white}},
    CodedPrimaries{7, "SMPTE 240M", {{0.630, 0.340}, {0.310, 0.595}, {0.155, 0.070}, screen_white}},
    CodedPrimaries{9, "Rec. 2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, screen_white}},
    CodedPrimaries{11, "DCI-P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.314, 0.351}}},
    CodedPrimaries{
        12, "Display P3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, screen_white}},
    CodedPrimaries{22, "EBU 3213", {{0.630, 0.340}, {0.295, 0.605}, {0.155, 0.077}, screen_white}}};

struct Curve {
  Transfer transfer;
  std::string name;
};

/// H.273, table 3, as a screen shows it.
Result<Curve> coded_curve(int code) {
  switch (code) {
    case 1:
    case 6:
    case 14:
    case 15:
      return Curve{{.gamma = 2.4}, "a screen of BT.1886"};
    case 4:
      return Curve{{.gamma = 2.2}, "gamma 2.2"};
    case 5:
      return Curve{{.gamma = 2.8}, "gamma 2.8"};
    case 8:
      return Curve{{}, "linear"};
    case 13:
      return Curve{srgb::space().transfer, "sRGB's curve"};
    default:
      break;
  }
  const std::string name = code == 2    ? " (unspecified)"
                           : code == 16 ? " (PQ of BT.2100, cd/m² without a white)"
                           : code == 18 ? " (HLG of BT.2100, which each screen shows otherwise)"
                                        : "";
  return problem("the picture's cICP names the transfer " + std::to_string(code) + name +
                 ", which is not read");
}

std::string fault_text(const PngPicture& png, const char* chunk) {
  return "what its " + std::string(chunk) + " says can't be used: " + png.faults.at(chunk);
}

Result<PngEncoding> by_cicp(const PngPicture& png) {
  const auto [primaries, transfer, matrix, full_range] = *png.cicp;
  if (matrix != 0)
    return problem("the picture's cICP names the matrix " + std::to_string(matrix) +
                   ", where a PNG has none (0)");
  if (full_range > 1)
    return problem("the picture's cICP names a range other than 0 and 1: " +
                   std::to_string(full_range));
  const CodedPrimaries* found = nullptr;
  for (const CodedPrimaries& one : coded_primaries)
    if (one.code == primaries) found = &one;
  if (found == nullptr)
    return problem("the picture's cICP names the primaries " + std::to_string(primaries) +
                   (primaries == 2 ? " (unspecified)" : "") + ", which are not read");
  Result<Curve> curve = coded_curve(transfer);
  if (!curve) return tl::unexpected<Problem>(curve.error());

  PngEncoding encoding{
      .primaries = found->primaries, .transfer = curve->transfer, .what = {}, .notes = {}};
  encoding.what = std::string(found->name) + "'s primaries, " + curve->name + " (cICP " +
                  std::to_string(primaries) + ", " + std::to_string(transfer) + ")";
  if (transfer == 1 || transfer == 6 || transfer == 14 || transfer == 15)
    encoding.notes.push_back(
        "its cICP names a camera's curve, which is taken for what a screen of "
        "BT.1886 (gamma 2.4) shows");
  if (full_range == 0) {  // H.273, 8.3: 16 and 219 of 8 bits, and as much more as there are more.
    const double unit = std::exp2(png.bits - 8), most = std::exp2(png.bits) - 1;
    encoding.black = 16 * unit / most;
    encoding.white = 235 * unit / most;
    encoding.what += ", video range";
  }
  return encoding;
}

/// gAMA and cHRM, one of which may not be there.
PngEncoding by_gamma(const PngPicture& png) {
  PngEncoding encoding{.primaries = srgb::space().primaries,
                       .transfer = srgb::space().transfer,
                       .what = {},
                       .notes = {}};
  if (const auto& c = png.chromaticities) {
    encoding.primaries = {
        {(*c)[2], (*c)[3]}, {(*c)[4], (*c)[5]}, {(*c)[6], (*c)[7]}, {(*c)[0], (*c)[1]}};
    encoding.what = "primaries of its own (cHRM)";
  } else {
    encoding.notes.emplace_back("it names no primaries: sRGB's are taken");
  }
  if (!encoding.what.empty()) encoding.what += ", ";
  if (png.gamma) {
    encoding.transfer = {.gamma = 1 / *png.gamma};
    encoding.what += "gamma " + number_text(std::round(1e5 / *png.gamma) / 1e5) + " (gAMA)";
  } else {
    encoding.what += "sRGB's curve";
    encoding.notes.emplace_back("it names no curve: sRGB's is taken");
  }
  return encoding;
}

}  // namespace

bool goes_by_icc(const PngPicture& png) {
  return !png.cicp && !png.faults.contains("cICP") &&
         (!png.icc_profile.empty() || png.faults.contains("iCCP"));
}

Result<PngEncoding> png_encoding(const PngPicture& png) {
  const auto bad = [&](const char* chunk) { return png.faults.contains(chunk); };
  if (bad("cICP")) return problem(fault_text(png, "cICP"));
  if (png.cicp) return by_cicp(png);
  if (bad("iCCP")) return problem(fault_text(png, "iCCP"));
  const RgbSpace& srgb = srgb::space();
  if (png.srgb)
    return PngEncoding{
        .primaries = srgb.primaries, .transfer = srgb.transfer, .what = srgb.name, .notes = {}};
  for (const char* chunk : {"sRGB", "gAMA", "cHRM"})
    if (bad(chunk)) return problem(fault_text(png, chunk));
  if (png.gamma || png.chromaticities) return by_gamma(png);
  return PngEncoding{.primaries = srgb.primaries,
                     .transfer = srgb.transfer,
                     .what = "sRGB, as it names no space",
                     .notes = {}};
}

}  // namespace metamer
