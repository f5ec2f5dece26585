// Every light of the table by both backends and in every shading; and GLSL's lights against f64.

#include "server/gl/lights.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/lights/reference.h"
#include "server/gl/buffer.h"
#include "server/gl/compute.h"
#include "server/gl/model_source.h"
#include "tests/server/gl/context_test.h"
#include "tests/server/gl/pictures.h"
#include "tests/server/methods/methods.h"

namespace metamer::gl {
namespace {

using lights::Entry, lights::Parameter;

/// A light of a line that shines on what lies at the origin, as a scene says it.
std::string light_text(const Entry& entry) {
  std::string own;
  for (const Parameter& one : entry.parameters) {
    if (one.kind == Parameter::Kind::position)
      own += std::string(one.name) + " { x: 0.2 y: 0.1 z: 2 } ";
    if (one.kind == Parameter::Kind::direction)
      own += std::string(one.name) + " { x: -0.1 y: -0.05 z: -1 } ";
  }
  const bool vector =
      entry.parameters.size() == 1 && lights::value_count(entry.parameters[0].kind) == 3;
  return vector ? own : std::string(entry.name) + " { " + own + "}";
}

/// A card and a ball before it.
SceneOnDisk scene_under(const Entry& entry, v1::Shading shading) {
  SceneOnDisk scene;
  const std::string text =
      "camera { eye { z: 4 } target {} } light { name: 'l' " + light_text(entry) +
      " spectrum { standard: 'D65' } } material { name: 'm' diffuse { constant: 0.5 } diffuseness: "
      "0.7 specularness: 0.3 blinn_phong { shininess: 20 } } object { name: 'card' material: 'm' "
      "quad { corner { x: -0.5 y: -0.5 } u { x: 1 } v { y: 1 } } } object { name: 'ball' material: "
      "'m' sphere { center { x: 0.1 z: 0.3 } radius: 0.2 } } settings { width: 48 height: 32 spp: "
      "1 shading: " +
      v1::Shading_Name(shading) + " }";
  if (!google::protobuf::TextFormat::ParseFromString(text, &scene.message))
    throw std::runtime_error("can't parse " + text);
  return scene;
}

class GlLights : public ContextTest {};

TEST_F(GlLights, EveryOneShinesByBothBackendsInEveryShading) {
  ProgramCache cache;
  for (const Entry& entry : lights::registry())
    for (const v1::Shading shading : {v1::PHONG, v1::CONSTANT, v1::GOURAUD, v1::QUADRATIC}) {
      if (entry.has_area) continue;  // declined by feature
      const Pictures pictures(scene_under(entry, shading));
      const auto cpu = pictures.by_cpu(test::exact());
      const auto gl = pictures.by_gl(test::exact(), cache);
      ASSERT_TRUE(gl) << gl.error().message;
      double brightest = 0;
      for (const auto* picture : {&cpu, &*gl})
        for (const float value : *picture) {
          ASSERT_TRUE(std::isfinite(value)) << entry.name;
          brightest = std::max(brightest, double{value});
        }
      EXPECT_GT(brightest, 0.2) << entry.name << " " << v1::Shading_Name(shading);
      const auto differences = pictures.differences(cpu, *gl);
      for (std::size_t i = 0; i < differences.size(); ++i) {
        if (!pictures.smooth()[i]) continue;
        ASSERT_LT(differences[i], 0.02) << entry.name;
      }
    }
}

TEST_F(GlLights, GlslIsTheReference) {
  constexpr std::size_t count = 4096, group = 64;
  std::mt19937 engine(2004);
  std::uniform_real_distribution<float> random(-2, 2);
  for (const Entry& entry : lights::registry()) {
    if (entry.has_area) continue;
    const RenderScene scene = compile(scene_under(entry, v1::PHONG));
    const auto words = light_words(scene);
    auto buffer = Buffer::of<std::uint32_t>("the lights", words);
    ASSERT_TRUE(buffer);
    const auto compute = Compute::compile(
        prelude() + light_source(scene) +
        "layout(local_size_x = 64) in;\n"
        "layout(std430, binding = 0) readonly buffer Inputs { float input_of[]; };\n"
        "layout(std430, binding = 1) writeonly buffer Outputs { float output_of[]; };\n"
        "void main() {\n"
        "    uint i = gl_GlobalInvocationID.x;\n"
        "    Incident got = incident(0u, vec3(input_of[3u * i], input_of[3u * i + 1u], input_of[3u "
        "* i + 2u]));\n"
        "    output_of[4u * i] = got.direction.x;\n"
        "    output_of[4u * i + 1u] = got.direction.y;\n"
        "    output_of[4u * i + 2u] = got.direction.z;\n"
        "    output_of[4u * i + 3u] = got.weight;\n"
        "}\n");
    ASSERT_TRUE(compute) << compute.error().message;
    std::vector<float> points(3 * count);
    for (float& value : points) value = random(engine);
    buffer->bind_storage(15);
    const auto outputs = compute->run(points, 4 * count, count / group);
    ASSERT_TRUE(outputs) << outputs.error().message;
    lights::Values<double> values = scene.lights[0].values();
    for (double& value : values) value = static_cast<float>(value);
    for (std::size_t i = 0; i < count; ++i) {
      const float* at = &points[3 * i];
      const float* got = &(*outputs)[4 * i];
      const auto expected = lights::incident(scene.lights[0].light, values, {at[0], at[1], at[2]});
      EXPECT_LT((Eigen::Vector3d(got[0], got[1], got[2]) - expected.direction).norm(), 1e-6);
      EXPECT_NEAR(got[3], expected.weight, 3e-5) << entry.name;
    }
  }
}

}  // namespace
}  // namespace metamer::gl
