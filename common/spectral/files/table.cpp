#include "common/spectral/files/table.h"

#include <algorithm>

#include "common/spectral/files/rows.h"
#include "common/spectral/files/tall_table.h"
#include "common/spectral/files/wide_table.h"

namespace metamer::spectrum_text {

Result<Contents> read_table(std::string_view text, const std::string& file) {
  const Lines lines(text);
  const bool empty = std::all_of(lines.all().begin(), lines.all().end(),
                                 [](const Lines::Line& line) { return line.comment; });
  if (empty) return problem_at(file, lines.end(), "the file has no data");
  if (const auto wide = find_wide(lines)) return read_wide(lines, *wide, file);
  return read_tall(lines, dialect_of(lines), file);
}

}  // namespace metamer::spectrum_text
