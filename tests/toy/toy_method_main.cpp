// Meets the method that add.cmake has added, by its word alone.

#include <cmath>
#include <cstdio>
#include <cstring>

#include "common/scene/methods.h"
#include "common/scene/validate.h"
#include "server/methods/method.h"
#include "tests/server/test_scene.h"

namespace {

using namespace metamer;

int failures = 0;

void expect(bool holds, const char* what) {
  std::printf("%s: %s\n", holds ? "ok" : "FAILED", what);
  failures += holds ? 0 : 1;
}

std::string scene(const std::string& method) {
  return "camera { eye { z: 4 } target {} } light { name: 'l' position { z: 4 } spectrum { "
         "standard: 'A' } } material { name: 'm' diffuse { constant: 0.5 } } object { name: 'o' "
         "material: 'm' sphere { radius: 1 } } settings { width: 33 height: 33 method { " +
         method + " {} } }";
}

bool is_among(const std::vector<v1::Method>& methods, const std::string& word) {
  for (const v1::Method& one : methods)
    if (method_text(one) == word) return true;
  return false;
}

}  // namespace

int main() {
  expect(method_words().find("toy") != std::string::npos, "clients offer it");
  expect(is_among(candidates(), "toy"), "a goal tries it");
  expect(is_among(compared_methods(), "toy"), "a trade-off compares it");
  expect(validate_scene(test::parse_scene(scene("toy"))).empty(), "a scene may have it");
  const auto picture = test::render(scene("toy")), exact = test::render(scene("exact"));
  expect(std::abs(picture.at(16, 16)[1] - 0.5f) < 1e-3f, "it renders");
  for (std::size_t axis = 0; axis < 3; ++axis)
    expect(std::abs(picture.at(16, 16)[axis] - exact.at(16, 16)[axis]) < 1e-4f,
           "grey under a light has the light's colour");
  return failures == 0 ? 0 : 1;
}
