#include "server/methods/band_table.h"

#include <algorithm>
#include <cassert>

namespace metamer {

BandTable::BandTable(std::size_t rows, std::size_t bands)
    : rows_(rows),
      bands_(bands),
      stride_((bands + band_pad - 1) / band_pad * band_pad),
      values_(new (std::align_val_t{64}) float[std::max<std::size_t>(rows, 1) * stride_]()) {}

void BandTable::set(std::size_t index, const std::vector<double>& values) {
  assert(values.size() <= stride_);
  std::transform(values.begin(), values.end(), row(index),
                 [](double value) { return static_cast<float>(value); });
}

std::vector<float> BandTable::packed() const {
  const std::size_t width = 4 * std::size_t{groups_of_four(bands_)};
  std::vector<float> all(rows_ * width);
  for (std::size_t i = 0; i < rows_; ++i) std::copy_n(row(i), bands_, &all[i * width]);
  return all;
}

}  // namespace metamer
