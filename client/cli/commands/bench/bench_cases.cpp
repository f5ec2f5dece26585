#include "client/cli/commands/bench/bench_cases.h"

#include <google/protobuf/descriptor.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "common/models/registry.h"
#include "common/scene/feature_sets.h"
#include "common/scene/methods.h"
#include "common/scene/settings.h"

namespace metamer::cli {
namespace {

using models::Entry;
using models::Kind;

constexpr int side = 6;  ///< Spheres in a row.
constexpr unsigned width = 320, height = 240, samples = 16, mirrors = 2;

void set(v1::Vec3& to, double x, double y, double z) {
  to.set_x(x);
  to.set_y(y);
  to.set_z(z);
}

void add_light(v1::Scene& scene, const char* standard, double x, double luminance) {
  v1::Light& light = *scene.add_light();
  set(*light.mutable_position(), x, 4, 2);
  light.mutable_spectrum()->set_standard(standard);
  light.set_luminance(luminance);
}

/// A floor and a field of spheres under two lights, all of one material that mirrors a little: the
/// camera sees a model wherever it looks.
v1::Scene field() {
  v1::Scene scene;
  set(*scene.mutable_camera()->mutable_eye(), 0, 2.4, 3.4);
  set(*scene.mutable_camera()->mutable_target(), 0, 0, -0.6);
  add_light(scene, "D65", -2, 0.7);
  add_light(scene, "F11", 3, 0.4);
  v1::Material& material = *scene.add_material();
  material.set_name("all");
  material.mutable_diffuse()->set_constant(0.6);
  material.mutable_specular()->set_constant(0.8);
  material.set_mirror(0.2);
  v1::Object& floor = *scene.add_object();
  floor.set_material("all");
  set(*floor.mutable_quad()->mutable_corner(), -20, 0, 10);
  set(*floor.mutable_quad()->mutable_u(), 40, 0, 0);
  set(*floor.mutable_quad()->mutable_v(), 0, 0, -40);
  for (int i = 0; i < side * side; ++i) {
    v1::Object& ball = *scene.add_object();
    ball.set_material("all");
    set(*ball.mutable_sphere()->mutable_center(), 0.6 * (i % side) - 1.5, 0.25,
        1.2 - 0.6 * (i / side));
    ball.mutable_sphere()->set_radius(0.25);
  }
  v1::Settings& settings = *scene.mutable_settings();
  settings.set_width(width);
  settings.set_height(height);
  settings.set_spp(samples);
  settings.set_depth(mirrors);
  v1::Point& point = *settings.mutable_method()->mutable_point();
  point.set_from(400);
  point.set_to(700);
  point.set_step(1);
  return scene;
}

/// Sets the material's member that a line of models.def stands for, with its defaults.
void choose(v1::Material& material, const Entry& entry) {
  const auto* field = v1::Material::descriptor()->FindFieldByNumber(entry.number);
  material.GetReflection()->MutableMessage(&material, field);
  if (entry.kind == Kind::model && (entry.traits & models::weighted)) {
    material.set_diffuseness(0.6);
    if (entry.traits & models::highlighted) material.set_specularness(0.4);
  }
}

/// A ball of triangles with normals, as the field's spheres are: `rings` from pole to pole.
std::string ball_as_ply(int rings) {
  constexpr double pi = std::numbers::pi;
  const int around = 2 * rings;
  std::string vertices, faces;
  char line[160];
  for (int ring = 0; ring <= rings; ++ring)
    for (int step = 0; step <= around; ++step) {
      const double down = pi * ring / rings, turn = 2 * pi * step / around;
      const double x = std::sin(down) * std::cos(turn), y = std::cos(down);
      const double z = -std::sin(down) * std::sin(turn);
      std::snprintf(line, sizeof line, "%.9g %.9g %.9g %.9g %.9g %.9g\n", 0.25 * x, 0.25 * y,
                    0.25 * z, x, y, z);
      vertices += line;
    }
  for (int ring = 0; ring < rings; ++ring)
    for (int step = 0; step < around; ++step) {
      const int at = ring * (around + 1) + step, below = at + around + 1;
      std::snprintf(line, sizeof line, "4 %d %d %d %d\n", at, below, below + 1, at + 1);
      faces += line;
    }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string((rings + 1) * (around + 1)) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
         "property float ny\nproperty float nz\nelement face " +
         std::to_string(rings * around) + "\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + faces;
}

BenchCase case_of(const Entry& model) {
  BenchCase one{model.name, field()};
  choose(*one.scene.mutable_material(0), model);
  return one;
}

}  // namespace

std::vector<BenchCase> model_cases() {
  std::vector<BenchCase> cases = {case_of(models::entry(models::Model::blinn_phong))};
  for (const Entry& model : models::registry(Kind::model))
    if (model.name != cases[0].name) cases.push_back(case_of(model));
  for (const Entry& model : models::registry(Kind::model)) {
    if (!(model.traits & models::has_fresnel)) continue;
    cases.push_back(case_of(model));
    cases.back().name += ", conductor Au";
    v1::Material& material = *cases.back().scene.mutable_material(0);
    material.clear_specular();
    material.mutable_fresnel()->mutable_conductor()->set_metal("Au");
  }
  for (const Entry& term : models::registry(Kind::diffuse)) {
    cases.push_back(case_of(models::entry(models::Model::lambert)));
    cases.back().name += std::string(", ") + term.name;
    choose(*cases.back().scene.mutable_material(0), term);
  }
  return cases;
}

std::vector<BenchCase> method_cases(bool multi_pass) {
  const auto add = [](std::vector<BenchCase>& to, std::string name) -> v1::Method& {
    to.push_back(case_of(models::entry(models::Model::blinn_phong)));
    to.back().name = std::move(name);
    v1::Method& method = *to.back().scene.mutable_settings()->mutable_method();
    method.Clear();
    return method;
  };
  std::vector<BenchCase> cases;
  add(cases, "rgb").mutable_rgb();
  for (const bool passes : {false, true}) {
    if (passes && !multi_pass) continue;
    for (const auto& [count, step] : {std::pair{7, 50.0}, {16, 20.0}, {61, 5.0}, {301, 1.0}}) {
      v1::Point& point =
          *add(cases, "point " + std::to_string(count) + (passes ? ", multi-pass" : ""))
               .mutable_point();
      point.set_from(400);
      point.set_to(700);
      point.set_step(step);
      point.set_multi_pass(passes);
    }
  }
  add(cases, "point fitted 8").mutable_point()->set_fitted(8);
  for (const MethodEntry& entry : method_entries()) {
    const v1::Method method = default_method(entry);
    if (!method.has_point() && !method.has_rgb()) add(cases, method_text(method)) = method;
  }
  return cases;
}

BenchCase shading_case(const Entry& model, v1::Shading shading, std::uint32_t points,
                       bool multi_pass) {
  static const std::string ply = ball_as_ply(8);
  BenchCase one = case_of(model);
  client::Upload mesh;
  mesh.name = "ball.ply";
  mesh.bytes = ply;
  mesh.size = ply.size();
  mesh.sha256 = sha256(ply);
  one.meshes.push_back(std::move(mesh));
  for (v1::Object& object : *one.scene.mutable_object()) {
    if (!object.has_sphere()) continue;
    *object.add_transform()->mutable_translate() = object.sphere().center();
    object.mutable_mesh()->set_file("ball.ply");
  }
  v1::Settings& settings = *one.scene.mutable_settings();
  settings.set_shading(shading);
  v1::Method& method = *settings.mutable_method();
  method.Clear();
  if (points == 0) {
    method.mutable_rgb();
    return one;
  }
  method.mutable_point()->set_from(400);
  method.mutable_point()->set_to(700);
  method.mutable_point()->set_step(300.0 / (points - 1));
  method.mutable_point()->set_multi_pass(multi_pass);
  return one;
}

std::string bench_scene_text(const v1::Scene& scene, const v1::Capabilities& capabilities) {
  const v1::Settings settings = with_defaults(scene.settings());
  const std::string mirrors =
      has_feature(capabilities, settings.backend(), Feature::mirrors)
          ? std::to_string(settings.depth()) + " mirror reflections"
          : "the " + name_of(settings.backend()) + " backend without mirrors";
  const bool meshes = scene.object(scene.object_size() - 1).has_mesh();
  return std::to_string(side * side) + (meshes ? " meshes" : " spheres") + ", 2 lights, " +
         mirrors + ", " + std::to_string(settings.width()) + "x" +
         std::to_string(settings.height()) + ", " + std::to_string(settings.spp()) +
         " samples per pixel";
}

}  // namespace metamer::cli
