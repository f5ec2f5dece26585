#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/transport/factor_kinds.h"
#include "server/scene/render_scene.h"
#include "server/transport/gather.h"

namespace metamer {

/// What a compiled scene's factors are made of; it must outlive the answer.
FactorSources factor_sources(const RenderScene& scene);

/// What a pixel of a scene gathers in: with what its materials re-radiate.
Gather gather_for(const RenderScene& scene);

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

  /// The rows of fluorescences, which have light of their own: RenderScene::reradiated.
  struct Reradiating {
    std::uint32_t row, fluorescence;
  };
  const std::vector<Reradiating>& reradiating() const { return reradiating_; }
  /// The fluorescence of a row; nothing: it is none.
  std::optional<std::uint32_t> fluorescence(std::uint32_t row) const;

  /// The materials that re-radiate. DirectTables have a row more for each, behind all of these:
  /// what their diffuse weights are worth, with what is re-radiated.
  const std::vector<std::uint32_t>& fluorescent() const { return fluorescent_; }
  /// The row there of a material's diffuse weight.
  std::uint32_t direct_diffuse(std::uint32_t material) const;

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
  std::vector<Reradiating> reradiating_;
  std::vector<std::uint32_t> fluorescent_;
  std::uint32_t size_ = 0;
};

}  // namespace metamer
