#include "common/scene/feature_sets.h"

#include <gtest/gtest.h>

namespace metamer {
namespace {

TEST(FeatureSets, SayWhatABackendHas) {
  v1::Capabilities capabilities;
  v1::FeatureSet& gl = *capabilities.add_backend_features();
  gl.set_name("gl");
  gl.add_feature("anisotropy");
  EXPECT_TRUE(has_feature(capabilities, v1::GL, Feature::anisotropy));
  EXPECT_FALSE(has_feature(capabilities, v1::GL, Feature::factors));
}

TEST(FeatureSets, LeaveItToTheServerWhereTheyAreSilent) {
  EXPECT_TRUE(has_feature({}, v1::GL, Feature::factors));
}

TEST(FeatureSets, NameBackendsAsPlansDo) {
  EXPECT_EQ(name_of(v1::CPU), "cpu");
  EXPECT_EQ(name_of(v1::GL), "gl");
}

}  // namespace
}  // namespace metamer
