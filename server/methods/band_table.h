#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace metamer {

/// Rows are padded to a multiple of it, so that loops over them are whole vectors.
inline constexpr std::size_t band_pad = 16;

/// A table of rows of f32, each row padded with zeros to a multiple of 16 and aligned to 64 bytes,
/// so that loops over a row are whole vectors.
class BandTable {
 public:
  BandTable(std::size_t rows, std::size_t bands);
  std::size_t rows() const { return rows_; }
  std::size_t bands() const { return bands_; }
  std::size_t stride() const { return stride_; }
  float* row(std::size_t index) { return values_.get() + index * stride_; }
  const float* row(std::size_t index) const { return values_.get() + index * stride_; }
  /// Copies as many values as a row has bands.
  void set(std::size_t index, const std::vector<double>& values);
  /// All rows, each padded to a multiple of 4 only.
  std::vector<float> packed() const;

 private:
  struct Free {
    void operator()(float* p) const { ::operator delete[](p, std::align_val_t{64}); }
  };
  std::size_t rows_, bands_, stride_;
  std::unique_ptr<float[], Free> values_;
};

/// A row of so many values in groups of four.
inline std::uint32_t groups_of_four(std::size_t values) {
  return static_cast<std::uint32_t>((values + 3) / 4);
}

}  // namespace metamer
