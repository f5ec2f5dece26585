#pragma once

#include <optional>

#include "common/transport/scene_bands.h"
#include "server/methods/band_table.h"
#include "server/methods/method.h"
#include "server/transport/factor_rows.h"

namespace metamer {

/// What `exact` knows of a scene.
struct ExactTables {
  /// Paths meet up to `depth` mirrors, and take up to `bounces` diffuse reflections.
  ExactTables(const RenderScene& scene, const Observer& observer, std::uint32_t depth,
              std::uint32_t bounces);

  /// What is seen of light of each emission that comes from a row, by band: a row an emission, of
  /// luminance 1.
  BandTable sensors(std::uint32_t row) const;

  /// X Y Z of a row by itself, three for each light.
  const float* direct_color(std::uint32_t row) const { return &direct[row * lights.size() * 3]; }
  DirectTables direct_tables() const;
  double preparation_cost() const;

  /// The emissions of lights; behind them, the bands have what is re-radiated.
  std::size_t emissions() const { return bands.lights() - reradiated.size(); }

  struct Light {
    std::uint32_t emission;
    float luminance;
  };

  SceneBands bands;
  FactorRows rows;
  BandTable white;     ///< The sensors of white.
  BandTable values;    ///< A row for each of FactorRows, by band.
  BandTable at_edges;  ///< The same by edge (ChainBands) of rows that are lines between these.
  std::vector<bool> is_linear;  ///< By row.
  std::vector<Light> lights;
  std::vector<float> reradiated;  ///< Luminances of RenderScene::reradiated.
  std::vector<float> direct;      ///< X Y Z by row and light, of the rows of DirectTables.
};

/// The sensors of the rows that a thread has met.
class MetSensors {
 public:
  explicit MetSensors(const ExactTables& tables) : tables_(tables), of_row_(tables.rows.size()) {}

  const BandTable& operator()(std::uint32_t row) {
    std::optional<BandTable>& own = of_row_[row];
    if (!own) {
      own = tables_.sensors(row);
      size_ += own->rows() * own->stride();
    }
    return *own;
  }

  /// Forgets everything before it grows too large; only between pixels.
  void bound() {
    if (size_ < most) return;
    for (std::optional<BandTable>& own : of_row_) own.reset();
    size_ = 0;
  }

 private:
  static constexpr std::size_t most = std::size_t{1} << 24;  ///< f32, 64 MiB.

  const ExactTables& tables_;
  std::vector<std::optional<BandTable>> of_row_;
  std::size_t size_ = 0;
};

}  // namespace metamer
