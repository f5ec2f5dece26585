#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/problem.h"
#include "common/transport/factor_sources.h"
#include "metamer/v1/factors.pb.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::client {

/// A picture before any spectrum: each pixel is a list of pairs of signature and weight, see
/// factors.proto. Sound by construction: every index lies within its table.
struct Factors {
  v1::Plan plan;
  v1::SceneFactors scene;
  v1::TileFactors tables;  ///< Products and signatures; no pixels.

  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> end;  ///< Of each pixel's pairs, row by row from the top.
  std::vector<std::uint32_t> signature;
  std::vector<float> weight;
};

/// Puts the tiles of a picture together: their tables become one.
class FactorsBuilder {
 public:
  /// Error: spectra that no server sends.
  static Result<FactorsBuilder> make(const v1::Plan& plan, const v1::SceneFactors& scene);

  /// Error: no factors, or factors that do not fit the tile, the scene or each other.
  Result<void> add(const v1::Tile& tile);
  /// Once, when all tiles are there.
  Factors finish();

 private:
  explicit FactorsBuilder(const v1::Plan& plan, const v1::SceneFactors& scene);

  struct Tile {
    std::uint32_t x, y, width;
    std::vector<std::uint32_t> count, signature;
    std::vector<float> weight;
  };
  /// The picture's numbers of a tile's signatures.
  std::vector<std::uint32_t> add_tables(const v1::TileFactors& tile);

  Factors factors_;
  std::vector<Tile> tiles_;
  std::uint64_t pairs_ = 0;
  struct Tables;
  std::shared_ptr<Tables> tables_;
};

/// The file: a head ("MTMRFACT", version, the sizes of what follows, the SHA-256 of it all;
/// little-endian), the plan, the scene and the tables as protobuf messages, then the pixels' `end`,
/// `signature` and `weight` as they are in memory. Appears whole or not at all.
Result<void> write_factors(const Factors& factors, const std::filesystem::path& file);

/// Errors name the file: it is no such file, of another version, cut short, or its numbers do not
/// fit each other. Takes no more memory than the file's size and a few times its head.
Result<Factors> read_factors(const std::filesystem::path& file);

/// What is wrong with the spectra of a scene; empty: they are sound.
std::string scene_fault(const v1::SceneFactors& scene);

/// What is wrong with tables, for so many lights and such materials; empty: they are sound.
std::string table_fault(const v1::TileFactors& tables, std::size_t lights,
                        const FactorSources& sources);

}  // namespace metamer::client
