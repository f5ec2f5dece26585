#include "client/cli/commands/spectra/bispectral.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "common/scene/files.h"
#include "common/spectral/files/bispectral_file.h"
#include "common/spectral/files/spectrum_file.h"

namespace metamer::cli {
namespace {

std::string range_text(const std::vector<double>& nm) {
  return number_text(nm.front()) + " to " + number_text(nm.back()) + " nm, " +
         std::to_string(nm.size()) + " wavelengths";
}

}  // namespace

std::optional<bool> tell_bispectral(const std::string& file, Report& report) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  const auto bytes = read_file(file, max_spectrum_file);
  if (!bytes || !is_bispectral(*bytes)) return std::nullopt;
  const auto matrix = read_bispectral_file(*bytes, file);
  if (!matrix) {
    report.problem(matrix.error(), *bytes);
    return false;
  }
  const std::vector<double> shares = reradiated_shares(*matrix, matrix->excitation);
  const auto most = std::max_element(shares.begin(), shares.end());
  const double at = matrix->excitation[static_cast<std::size_t>(most - shares.begin())];
  const double largest = *std::max_element(matrix->values.begin(), matrix->values.end());
  report.document()["spectra"].push_back({{"name", file},
                                          {"kind", "bispectral matrix"},
                                          {"excitation",
                                           {{"from", matrix->excitation.front()},
                                            {"to", matrix->excitation.back()},
                                            {"samples", matrix->excitation.size()}}},
                                          {"emission",
                                           {{"from", matrix->emission.front()},
                                            {"to", matrix->emission.back()},
                                            {"samples", matrix->emission.size()}}},
                                          {"max", largest},
                                          {"largest_share", *most},
                                          {"largest_share_at", at}});
  char text[160];
  std::snprintf(text, sizeof text,
                "\n  values       up to %.6g per nm\n  re-radiates  at most %.4g of what comes, of "
                "light of %g nm",
                largest, *most, at);
  report.line(file + ": bispectral matrix\n  excitation   " + range_text(matrix->excitation) +
              "\n  emission     " + range_text(matrix->emission) + text);
  return true;
}

}  // namespace metamer::cli
