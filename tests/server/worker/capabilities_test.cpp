#include "server/worker/capabilities.h"

#include "common/scene/feature_sets.h"
#include "common/scene/validate.h"
#include "tests/server/test_scene.h"
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

TEST_F(WorkerCapabilities, NameWordsThatTheSchemaHasAsStringsAndAValidSceneMayUse) {
  const v1::Capabilities all = capabilities(options_, {});
  const auto findings = [](const std::string& spectrum, const std::string& fresnel) {
    return validate_scene(test::parse_scene(
        "camera { eye { z: 3 } } light { position { y: 2 } spectrum { " + spectrum +
        " } } material { name: 'm' mirror: 1 cook_torrance {} fresnel { " + fresnel +
        " } } object { material: 'm' sphere { radius: 1 } }"));
  };
  const std::string d65 = "standard: 'D65'", water = "dielectric { medium: 'water' }";
  ASSERT_EQ(all.choice_size(), 3);
  std::vector<std::string> fields;
  for (const v1::Choice& choice : all.choice()) {
    fields.push_back(choice.field());
    EXPECT_GT(choice.word_size(), 3) << choice.field();
    const std::size_t dot = choice.field().find('.');
    const std::string message = choice.field().substr(0, dot);
    for (const std::string& word : choice.word()) {
      const std::string field = choice.field().substr(dot + 1) + ": '" + word + "'";
      const auto wrong = message == "spectrum" ? findings(field, water)
                                               : findings(d65, message + " { " + field + " }");
      EXPECT_TRUE(wrong.empty()) << field << ": " << wrong.front().message;
    }
  }
  EXPECT_EQ(fields, (Names{"spectrum.standard", "dielectric.medium", "conductor.metal"}));
}

}  // namespace
}  // namespace metamer::worker
