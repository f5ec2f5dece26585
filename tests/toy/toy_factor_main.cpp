// Meets the kind of factor that add.cmake has added, by its name alone: every method, the
// reference and relighting carry it.

#include <cmath>
#include <cstdio>
#include <cstring>

#include "client/relight/factors.h"
#include "client/relight/relight.h"
#include "server/film/factor_sink.h"
#include "server/plan/plan.h"
#include "server/plan/reference.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace {

using namespace metamer;
using namespace metamer::client;

int failures = 0;

void expect(bool holds, const std::string& what) {
  std::printf("%s: %s\n", holds ? "ok" : "FAILED", what.c_str());
  failures += holds ? 0 : 1;
}

const FactorEntry* find_toy() {
  for (const FactorEntry& entry : factor_entries)
    if (std::strcmp(entry.name, "toy") == 0) return &entry;
  return nullptr;
}

struct NoPicture : PixelSink {
  void take(std::uint32_t, std::uint32_t, const Gather&) override {}
};

/// Y of a picture of this pixel, by way of the tables of a file.
float relit(const RenderScene& scene, const Gather& gather) {
  NoPicture none;
  FactorSink sink(none, 1);
  sink.begin({0, 0, 1, 1});
  sink.take(0, 0, gather);
  v1::Tile tile;
  tile.set_width(1);
  tile.set_height(1);
  tile.set_factors(sink.finish().SerializeAsString());
  v1::Plan plan;
  plan.set_width(1);
  plan.set_height(1);
  auto builder = FactorsBuilder::make(plan, scene_factors(scene));
  if (!builder || !builder->add(tile)) return 0;
  return relight(builder->finish(), scene_factors(scene), cie::observer_1931()).pixels[1];
}

}  // namespace

int main() {
  const FactorEntry* toy = find_toy();
  expect(toy != nullptr, "the table has it");
  if (toy == nullptr) return 1;

  // Light of Y = 1 over an optical length of 0.53, between two nodes, from the paint; and half of
  // it at a node.
  const RenderScene scene = test::compile_text(
      "camera { eye { z: 4 } target {} } light { name: 'l' position { z: 4 } spectrum { standard: "
      "'D65' } } "
      "material { name: 'm' diffuse { constant: 0.5 } } object { name: 'o' material: 'm' sphere { "
      "radius: 1 } }");
  Gather gather(1);
  const auto chain = gather.chain(0, {toy->kind, 0, 0.53f});
  gather.weights(gather.surface(chain, 0), 0) = {1, 0, 0};
  gather.add(0, 0, {toy->kind, 0, 32}, 0.5f);
  const double expected = 0.5 * std::exp(-0.5 * 0.53) + 0.5 * std::exp(-0.5 * 2);
  const auto is_it = [&](double y) { return std::abs(y - expected) < 2e-4; };

  for (const v1::Method& method : test::all_methods()) {
    v1::Settings settings;
    *settings.mutable_method() = method;
    const v1::Plan plan = make_plan(scene, settings, {.threads = 1});
    expect(is_it(test::resolve(*make_method(plan, scene), gather)[1]), method.ShortDebugString());
  }
  Reference reference(scene, cie::observer_1931());
  expect(is_it(reference.resolve(gather, 1)[1]), "the reference");
  expect(is_it(relit(scene, gather)), "relighting");
  return failures == 0 ? 0 : 1;
}
