#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// Scenes on which no heuristic was tuned: drawn at random, the same ones each time.
namespace metamer::promises {

struct VariedScene {
  std::string about;  ///< "3 lights (F11, spikes, A), 6 materials, depth 2"
  std::string text;   ///< Protobuf text format; needs no assets.
};

/// Lights: CIE illuminants, LEDs and lines of some nm, one to three of them. Materials: test colors
/// as smooth curves, edges, narrow bands, metals and glass. Depth 0 to 4. `side` is the picture's
/// width in pixels.
std::vector<VariedScene> varied_scenes(std::uint32_t count, std::uint32_t side,
                                       std::uint32_t spp = 4);

/// The same with lines of 0.05 to 1 nm among the lights: lasers, gas discharges, laser phosphors,
/// single lines, on even and uneven grids; the first light has some.
std::vector<VariedScene> narrow_scenes(std::uint32_t count, std::uint32_t side,
                                       std::uint32_t spp = 4);

}  // namespace metamer::promises
