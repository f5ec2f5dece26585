#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/spectral/files/contents.h"
#include "common/spectral/files/rows.h"

namespace metamer::spectrum_text {

/// A table whose columns are wavelengths, and whose lines are spectra.
struct Wide {
  std::size_t heading = 0;  ///< In Lines.
  Dialect dialect{};
  std::vector<std::size_t> columns = {};  ///< The spectral ones.
  std::vector<double> at = {};
  std::optional<WavelengthUnit> unit = {};
};

/// The heading of a wide table: with the most wavelengths of all ways to cut it. Nothing: the table
/// is no such one.
std::optional<Wide> find_wide(const Lines& lines);

Result<Contents> read_wide(const Lines& lines, const Wide& wide, const std::string& file);

}  // namespace metamer::spectrum_text
