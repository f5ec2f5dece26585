// Meets the model that add_model.cmake has added, by its name alone.

#include <google/protobuf/text_format.h>

#include <cstdio>
#include <cstring>

#include "common/models/reference.h"
#include "common/scene/validate.h"
#include "server/models/lanes.h"
#include "tests/server/test_scene.h"

namespace {

using namespace metamer;

int failures = 0;

void expect(bool holds, const char* what) {
  std::printf("%s: %s\n", holds ? "ok" : "FAILED", what);
  failures += holds ? 0 : 1;
}

std::string scene(const std::string& model) {
  return "camera { eye { z: 4 } target {} } light { name: 'l' position { z: 4 } spectrum { "
         "standard: "
         "'D65' } } material { name: 'm' diffuse { constant: 0.5 } diffuseness: 0.5 specularness: "
         "0.25 " +
         model +
         " } object { name: 'o' material: 'm' sphere { radius: 1 } } settings { width: 33 height: "
         "33 "
         "}";
}

const models::Entry* find_toy() {
  for (const models::Entry& entry : models::registry(models::Kind::model))
    if (std::strcmp(entry.name, "toy") == 0) return &entry;
  return nullptr;
}

}  // namespace

int main() {
  const models::Entry* toy = find_toy();
  expect(toy != nullptr && toy->parameters.size() == 1, "the registry has it, with its parameter");
  if (toy == nullptr) return 1;

  const auto wrong = validate_scene(test::parse_scene(scene("toy { edge: 2 }")));
  expect(wrong.size() == 1 && wrong[0].message.find("edge must lie in 0..1") == 0,
         "validation knows its range");

  models::Reflection<double> in_f64{.model = static_cast<models::Model>(toy->index),
                                    .parameters = {0.5, 0.25, 0.9}};
  models::Reflection<float> in_f32{.model = in_f64.model, .parameters = {0.5f, 0.25f, 0.9f}};
  const auto f64 = models::evaluate(in_f64, {0.5, 1, 0.95, 1, 1, 0, 1, 1});
  models::Angles<Float8> angles{};
  angles.n_dot_l = broadcast(0.5f);
  angles.n_dot_h = broadcast(0.95f);
  const auto f32 = models::evaluate(in_f32, angles);
  expect(f64.white == 0.25 && f64.diffuse == 0.25, "f64 evaluates it");
  expect(f32.white[7] == 0.25f && f32.diffuse[7] == 0.25f, "eight lanes of f32 evaluate it");

  // In the middle N·H = 1, above the step; 0.7 of the radius out it is below.
  const auto picture = test::render(scene("toy { edge: 0.9 }"));
  expect(std::abs(picture.at(16, 16)[1] - 0.5f) < 1e-3f, "it renders its highlight");
  expect(picture.at(25, 16)[1] > 0.05f && picture.at(25, 16)[1] < 0.25f, "and its diffuse part");
  return failures == 0 ? 0 : 1;
}
