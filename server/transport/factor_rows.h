#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "common/transport/factor_kinds.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// What a compiled scene's factors are made of; it must outlive the answer.
FactorSources factor_sources(const RenderScene& scene);

/// Everything by which a scene multiplies light, as numbered rows: a row for each distinct node of
/// its factors (common/transport/factors.def). Methods keep a table of what each row is to them;
/// nothing here has wavelengths.
class FactorRows {
 public:
  explicit FactorRows(const RenderScene& scene);

  static constexpr std::uint32_t white = 0;
  std::uint32_t size() const { return size_; }

  std::uint32_t row(const FactorNode& factor) const {
    return first_[factor.index * factor_kind_count + static_cast<std::size_t>(factor.kind)] +
           factor.node;
  }
  /// Of a material's spectra.
  std::uint32_t diffuse(std::uint32_t material) const {
    return row({FactorKind::diffuse, material, 0});
  }
  std::uint32_t specular(std::uint32_t material) const {
    return row({FactorKind::specular, material, 0});
  }

  /// What a factor is in rows: a weighted sum of one or two.
  struct Mix {
    std::array<std::uint32_t, 2> row;
    std::array<float, 2> weight;
    std::size_t count;
  };
  Mix mix(const Factor& factor) const;

  /// Gives each row's values at `nm`, in the order of the rows.
  void for_each(
      const RenderScene& scene, const std::vector<double>& nm,
      const std::function<void(std::uint32_t row, std::vector<double> values)>& take) const;

  /// Gives the spectrum of each row that is one.
  void for_each_spectrum(
      const RenderScene& scene,
      const std::function<void(std::uint32_t row, const Spectrum& spectrum)>& take) const;

 private:
  /// Rows that follow each other: the nodes of one table.
  struct Table {
    FactorKind kind;
    std::uint32_t index;
  };
  std::vector<Table> tables_;  ///< In the order of their rows.
  std::vector<std::uint32_t>
      first_;  ///< The first row of each index and kind; 0 where it has none.
  std::uint32_t size_ = 0;
};

}  // namespace metamer
