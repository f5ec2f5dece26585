#pragma once

#include <random>

#include "server/scene/render_scene.h"
#include "server/transport/gather.h"

/// Light's ways to a pixel drawn at random, and what they come to: Σ weight · light · Π factors
/// term by term, in f64, by none of the code that is tested.
namespace metamer::test {

/// Three lights, surfaces of every kind.
RenderScene transport_scene();

/// Up to six terms of each kind of factor and as many surfaces, over chains of 0 to 8 factors of
/// any kind. The same on every run.
Gather random_gather(const RenderScene& scene, std::mt19937& random);

using Spectra = std::vector<double>;

/// What the factors are at `nm`, by their equations; a factor between two nodes of a table lies on
/// the line between them.
Spectra values_of(const RenderScene& scene, const FactorNode& factor, const Spectra& nm);
/// As nodes and their shares.
std::vector<std::pair<FactorNode, double>> nodes_of(const Factor& factor);

/// A term with the factors of its chain, the one next to the eye first.
struct Way {
  double weight;
  std::uint32_t light;
  FactorNode last;
  std::vector<Factor> chain;
};
std::vector<Way> ways(const Gather& gather);

}  // namespace metamer::test
