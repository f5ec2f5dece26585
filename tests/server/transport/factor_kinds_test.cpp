// What every line of factors.def owes.

#include "common/transport/factor_kinds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "metamer/v1/factors.pb.h"
#include "server/transport/expand.h"
#include "server/transport/factor_rows.h"
#include "tests/server/test_scene.h"
#include "tests/server/transport/closed_form.h"

namespace metamer::test {
namespace {

TEST(FactorKinds, BearTheNumbersOfTheMessage) {
  for (const FactorEntry& entry : factor_entries) {
    std::string name = std::string("FACTOR_") + entry.name;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    EXPECT_EQ(v1::FactorTerm_Name(static_cast<v1::FactorTerm>(entry.kind)), name);
  }
  EXPECT_EQ(static_cast<std::size_t>(v1::FactorTerm_descriptor()->value_count()),
            factor_kind_count);
}

TEST(FactorKinds, AFactorIsAWeightedMeanOfNodesThatThereAre) {
  for (const FactorEntry& entry : factor_entries)
    for (const float at : {0.0f, 1e-30f, 1e-6f, 0.25f, 0.5f, 0.999999f, 1.0f}) {
      const auto nodes = expand<float>({entry.kind, 0, at});
      ASSERT_TRUE(nodes.count == 1 || nodes.count == 2);
      float sum = 0;
      for (std::size_t i = 0; i < nodes.count; ++i) {
        EXPECT_TRUE(nodes.weight[i] >= -1e-4f && nodes.weight[i] <= 1.0001f) << at;
        with_kind(nodes.node[i].kind, [&]<class Kind>(Kind) {
          EXPECT_LT(nodes.node[i].node, Kind::Table::nodes) << entry.name;
        });
        sum += nodes.weight[i];
      }
      EXPECT_NEAR(sum, 1, 1e-6) << entry.name << " at " << at;
    }
}

TEST(FactorRows, AreOneForEachNodeOfEachDistinctSource) {
  // Three surfaces share their spectra, two of them their metal.
  const RenderScene scene = compile_text(R"(
    camera { eye { z: 3 } target {} }
    light { name: "a" position { y: 2 } spectrum { standard: "A" } }
    material { name: "p" diffuse { constant: 0.5 } specular { constant: 0.5 } specularness: 0.5 blinn_phong {} }
    material { name: "q" diffuse { constant: 0.5 } mirror: 1 fresnel { conductor { metal: "Au" } } }
    material { name: "r" diffuse { constant: 0.2 } mirror: 1 fresnel { conductor { metal: "Au" } } }
    object { name: "o" material: "p" sphere { radius: 1 } })");
  const FactorRows rows(scene);
  EXPECT_EQ(rows.size(), 1 + 3 + fresnel_nodes);  // white; 0.5, 0.2 and 1; gold
  EXPECT_EQ(rows.diffuse(0), rows.specular(0));
  EXPECT_EQ(rows.diffuse(0), rows.diffuse(1));
  EXPECT_NE(rows.diffuse(0), rows.diffuse(2));
  EXPECT_EQ(rows.row({FactorKind::white, 0, 0}), FactorRows::white);
  EXPECT_EQ(rows.row({FactorKind::fresnel, 1, 7}), rows.row({FactorKind::fresnel, 2, 7}));
  EXPECT_EQ(rows.row({FactorKind::fresnel, 1, 7}), rows.row({FactorKind::fresnel, 1, 0}) + 7);
}

TEST(FactorRows, HoldWhatTheirFactorsAre) {
  const RenderScene scene = transport_scene();
  const FactorRows rows(scene);
  const FactorSources sources = factor_sources(scene);
  const std::vector<double> nm{380, 500.5, 560, 700};
  std::vector<std::vector<double>> values;
  rows.for_each(scene, nm, [&](std::uint32_t row, std::vector<double> own) {
    EXPECT_EQ(row, values.size());
    values.push_back(std::move(own));
  });
  ASSERT_EQ(values.size(), rows.size());
  for (const FactorEntry& entry : factor_entries)
    with_kind(entry.kind, [&]<class Kind>(Kind) {
      for (std::uint32_t index = 0; index < Kind::count(sources); ++index) {
        if (Kind::source(sources, index) == nullptr) continue;
        for (std::uint32_t node = 0; node < Kind::Table::nodes; ++node) {
          const FactorNode factor{entry.kind, index, node};
          const std::vector<double>& own = values[rows.row(factor)];
          const std::vector<double> expected = values_of(scene, factor, nm);
          ASSERT_EQ(own.size(), expected.size());
          for (std::size_t i = 0; i < own.size(); ++i)
            EXPECT_NEAR(own[i], expected[i], 1e-8) << entry.name << ' ' << node;
        }
      }
    });
}

}  // namespace
}  // namespace metamer::test
