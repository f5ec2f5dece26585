// Meets the model and the light that add.cmake has added, by their names alone.

#include <google/protobuf/text_format.h>

#include <cstdio>
#include <cstring>

#include "common/lights/reference.h"
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

std::string scene(const std::string& model, const std::string& light = "position { z: 4 }") {
  return "camera { eye { z: 4 } target {} } light { name: 'l' " + light +
         " spectrum { standard: 'D65' } } material { name: 'm' diffuse { constant: 0.5 } "
         "diffuseness: 0.5 specularness: "
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

const lights::Entry* find_toy_light() {
  for (const lights::Entry& entry : lights::registry())
    if (std::strcmp(entry.name, "toy") == 0) return &entry;
  return nullptr;
}

void meet_light() {
  const lights::Entry* toy = find_toy_light();
  expect(toy != nullptr && toy->parameters.size() == 3, "the lights' registry has it");
  if (toy == nullptr) return;

  const std::string light = "toy { position { z: 4 } direction { z: -2 } edge: ";
  const auto wrong = validate_scene(test::parse_scene(scene("blinn_phong {}", light + "2 }")));
  expect(wrong.size() == 1 && wrong[0].field == "light[0].toy.edge" &&
             wrong[0].message.find("edge must lie in 0..1") == 0,
         "validation knows its range");
  const lights::Values<double> values{0, 0, 0, 4, 0, 0, -1, 0.9};
  const auto which = static_cast<lights::Light>(toy->index);
  expect(lights::incident(which, values, {0, 0, 0}).weight == 1, "f64 evaluates it on its axis");
  expect(lights::incident(which, values, {0, 4, 0}).weight == 0, "and beside it");

  // The ball's middle is on the axis, its rim 14° off it: beyond a step at 6°. Where N·H is above
  // the model's step it is 0.25 and the paint's 0.25.
  const auto picture = test::render(scene("toy { edge: 0.9 }", light + "0.995 }"));
  expect(std::abs(picture.at(16, 16)[1] - 0.5f) < 1e-3f, "it renders where it shines");
  expect(picture.at(16, 25)[1] == 0, "and is dark beyond its edge");
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
  models::Angles<double> exact{};
  exact.n_dot_l = 0.5;
  exact.n_dot_h = 0.95;
  const auto f64 = models::evaluate(in_f64, exact);
  models::Angles<Floats> angles{};
  angles.n_dot_l = broadcast(0.5f);
  angles.n_dot_h = broadcast(0.95f);
  const auto f32 = models::evaluate(in_f32, angles);
  expect(f64.white == 0.25 && f64.diffuse == 0.25, "f64 evaluates it");
  expect(f32.white[7] == 0.25f && f32.diffuse[7] == 0.25f, "eight lanes of f32 evaluate it");

  // In the middle N·H = 1, above the step; 0.7 of the radius out it is below.
  const auto picture = test::render(scene("toy { edge: 0.9 }"));
  expect(std::abs(picture.at(16, 16)[1] - 0.5f) < 1e-3f, "it renders its highlight");
  expect(picture.at(25, 16)[1] > 0.05f && picture.at(25, 16)[1] < 0.25f, "and its diffuse part");
  meet_light();
  return failures == 0 ? 0 : 1;
}
