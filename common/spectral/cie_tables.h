#pragma once

#include <span>
#include <string_view>

/// What embed/embed_cie_main.cpp writes at build time from colord-data. Use cie.h instead.
namespace metamer::cie::tables {

struct Table {
  std::string_view name;
  std::span<const double> nm;
  std::span<const double> values;
};

extern const std::span<const Table> observers;    ///< x̄ ȳ z̄ of 1931, then of 1964.
extern const std::span<const Table> illuminants;  ///< Named as in cie.h.
extern const std::span<const Table> test_colors;  ///< TCS01 … TCS15.
extern const std::span<const Table> daylight;     ///< S₀ S₁ S₂.

}  // namespace metamer::cie::tables
