#include "server/methods/direct_tables.h"

namespace metamer {

DirectTables tables_of_colors(const std::vector<std::vector<float>>& colors) {
  DirectTables tables{.size = 1,
                      .row_stride = static_cast<std::uint32_t>(colors.front().size() / 3),
                      .light_stride = 1,
                      .sensor_stride = 0,
                      .values = {},
                      .sensors = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                      .lights = {},
                      .observer = {}};
  for (const std::vector<float>& row : colors)
    for (std::size_t i = 0; i < row.size(); i += 3)
      tables.values.insert(tables.values.end(), {row[i], row[i + 1], row[i + 2], 0});
  return tables;
}

}  // namespace metamer
