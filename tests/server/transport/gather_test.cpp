#include "server/transport/gather.h"

#include <gtest/gtest.h>

namespace metamer {
namespace {

constexpr Factor mirror(std::uint32_t material, float cosine = 1) {
  return {FactorKind::specular, material, cosine};
}

TEST(Gather, NeverHoldsTheSameCombinationTwice) {
  Gather gather(3);
  EXPECT_EQ(gather.chain(0, mirror(7)), gather.chain(0, mirror(7)));
  EXPECT_NE(gather.chain(0, mirror(7)), gather.chain(0, mirror(8)));
  EXPECT_NE(gather.chain(0, mirror(7)), gather.chain(gather.chain(0, mirror(7)), mirror(7)));
  EXPECT_NE(gather.chain(0, mirror(7)), gather.chain(0, mirror(7, 0.5f)));
  EXPECT_NE(gather.chain(0, mirror(7)), gather.chain(0, {FactorKind::fresnel, 7, 1}));
  EXPECT_EQ(gather.surface(1, 7), gather.surface(1, 7));
  EXPECT_NE(gather.surface(1, 7), gather.surface(0, 7));
  EXPECT_EQ(gather.surfaces().size(), 2u);
  EXPECT_EQ(gather.chains().size(), 6u);
  gather.clear();
  EXPECT_EQ(gather.surfaces().size(), 0u);
  EXPECT_EQ(gather.chains().size(), 1u);
}

TEST(Gather, SumsTheWeightsOfATermAndKeepsOthersApart) {
  Gather gather(2);
  const FactorNode node{FactorKind::fresnel, 4, 9};
  gather.add(0, 1, node, 0.5f);
  gather.add(0, 1, {FactorKind::fresnel, 4, 10}, 1);
  gather.add(0, 1, {FactorKind::fresnel, 5, 9}, 1);
  gather.add(0, 1, {FactorKind::diffuse, 4, 9}, 1);
  gather.add(0, 0, node, 1);
  gather.add(gather.chain(0, mirror(7)), 1, node, 1);
  gather.add(0, 1, node, 0.25f);
  ASSERT_EQ(gather.terms().size(), 6u);
  EXPECT_EQ(gather.terms()[0].weight, 0.75f);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_EQ(gather.terms()[i].weight, 1) << i;
  gather.clear();
  EXPECT_TRUE(gather.terms().empty());
}

}  // namespace
}  // namespace metamer
