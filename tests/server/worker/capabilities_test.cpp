#include "server/worker/capabilities.h"

#include "common/scene/feature_sets.h"
#include "tests/server/worker/worker_fixture.h"

namespace metamer::worker {
namespace {

class WorkerCapabilities : public WorkerTest {};

TEST_F(WorkerCapabilities, TellEachBackendsAndEachMethodsFeatures) {
  const v1::Capabilities all =
      capabilities(options_, {{"cpu", Features::all()}, {"gl", {Feature::anisotropy}}});
  ASSERT_EQ(all.backend_size(), 1);
  EXPECT_EQ(all.backend(0), "fake");  // what this worker draws by
  EXPECT_EQ(all.threads(), 1u);
  EXPECT_TRUE(has_feature(all, v1::CPU, Feature::mirrors));
  EXPECT_TRUE(has_feature(all, v1::GL, Feature::anisotropy));
  EXPECT_FALSE(has_feature(all, v1::GL, Feature::mirrors));
  ASSERT_EQ(all.method_features_size(), all.method_size());
  for (int i = 0; i < all.method_size(); ++i) {
    EXPECT_EQ(all.method_features(i).name(), all.method(i));
    EXPECT_GT(all.method_features(i).feature_size(), 0);
  }
}

}  // namespace
}  // namespace metamer::worker
