// The table of methods holds each of the schema's, and each has what it says.
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "common/scene/methods.h"
#include "common/transport/factor.h"
#include "server/methods/method.h"
#include "server/plan/plan.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

TEST(MethodTable, HasEachMemberOfTheSchemaOnceAsClientsDo) {
  std::multiset<std::string> members, arithmetic, clients;
  const auto& oneof = *v1::Method::descriptor()->FindOneofByName("method");
  for (int i = 0; i < oneof.field_count(); ++i) members.insert(oneof.field(i)->name());
  for (const MethodArithmetic& one : method_arithmetic()) arithmetic.insert(one.word);
  for (const MethodEntry& one : method_entries()) clients.insert(one.word);
  EXPECT_EQ(arithmetic, members);
  EXPECT_EQ(clients, members);
}

/// Y of a pixel whose light comes along a chain of this factor.
double seen_along(const Factor& factor, const Method& method) {
  Gather gather(1);
  gather.weights(gather.surface(gather.chain(0, factor), 0), 0) = {1, 0, 0};
  return resolve(method, gather)[1];
}

TEST(MethodTable, EachCarriesWhatItSaysItHas) {
  // Paint gives back a half; glass of n = 1.5 a 25th at right angles and all at the horizon.
  const RenderScene scene = compile_text(
      "camera { eye { z: 4 } target {} } light { name: 'l' position { z: 4 } spectrum { standard: "
      "'D65' } } material { name: 'm' diffuse { constant: 0.5 } mirror: 0.5 cook_torrance {} "
      "fresnel { dielectric { n { constant: 1.5 } } } } object { name: 'o' material: 'm' "
      "sphere { radius: 1 } }");
  for (const v1::Method& choice : all_methods()) {
    v1::Settings settings;
    *settings.mutable_method() = choice;
    const auto method = make_method(make_plan(scene, settings, {.threads = 1}), scene);
    const double alone = seen_along({FactorKind::white, 0, 0}, *method);
    const auto share = [&](const Factor& factor) { return seen_along(factor, *method) / alone; };

    const Features has = method_features(choice);
    const std::string name = choice.ShortDebugString();
    EXPECT_TRUE(has.has(Feature::mirrors)) << name;
    EXPECT_NEAR(share({FactorKind::diffuse, 0, 0}), 0.5, 1e-4) << name;
    EXPECT_TRUE(has.has(Feature::exact_fresnel)) << name;
    EXPECT_NEAR(share({FactorKind::fresnel, 0, 1}), 0.04, 1e-4) << name;
    EXPECT_NEAR(share({FactorKind::fresnel, 0, 0}), 1, 1e-4) << name;
    EXPECT_EQ(has.has(Feature::multi_pass), choice.has_point()) << name;
  }
}

}  // namespace
}  // namespace metamer::test
