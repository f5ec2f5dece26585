#include "tests/bench/bench_scene.h"

#include <cmath>
#include <numbers>

#include "common/spectral/cie.h"

namespace metamer::bench {
namespace {

constexpr unsigned stripes = 8;

/// Height and unit normal of the ground at x, z in metres.
double height(double x, double z) { return 0.06 * std::sin(9 * x) * std::cos(8 * z); }
std::array<float, 3> normal(double x, double z) {
  const Eigen::Vector3f n = Eigen::Vector3d(-0.54 * std::cos(9 * x) * std::cos(8 * z), 1,
                                            0.48 * std::sin(9 * x) * std::sin(8 * z))
                                .normalized()
                                .cast<float>();
  return {n.x(), n.y(), n.z()};
}

/// The stripe from x0 to x0 + width, as a mesh.
TriangleMesh stripe(double x0, double width, unsigned columns, unsigned rows) {
  std::vector<Float3> positions, normals;
  std::vector<Triangle> triangles;
  for (unsigned row = 0; row <= rows; ++row)
    for (unsigned column = 0; column <= columns; ++column) {
      const double x = x0 + width * column / columns, z = -2 + 4.0 * row / rows;
      positions.push_back(
          {static_cast<float>(x), static_cast<float>(height(x, z)), static_cast<float>(z)});
      normals.push_back(normal(x, z));
    }
  for (unsigned row = 0; row < rows; ++row)
    for (unsigned column = 0; column < columns; ++column) {
      const unsigned a = row * (columns + 1) + column, b = a + columns + 1;
      triangles.push_back({a, b, a + 1});
      triangles.push_back({a + 1, b, b + 1});
    }
  TriangleMesh mesh;
  mesh.positions = Array(std::move(positions));
  mesh.normals = std::move(normals);
  mesh.triangles = std::move(triangles);
  return mesh;
}

}  // namespace

RenderScene make_ground(unsigned side, bool mirrors) {
  RenderScene scene;
  const Eigen::Vector3d eye(0, 2.2, 3.2), target(0, 0, 0);
  scene.camera.eye = eye;
  scene.camera.forward = (target - eye).normalized();
  scene.camera.right = scene.camera.forward.cross(Eigen::Vector3d::UnitY()).normalized();
  scene.camera.up = scene.camera.right.cross(scene.camera.forward);
  scene.camera.tan_half_fov = std::tan(0.33);

  scene.emissions = {*cie::illuminant("D65"), *cie::illuminant("F11")};
  scene.emission_fields = {"light[0].spectrum", "light[1].spectrum"};
  const auto lamp = [](const char* name, Eigen::Vector3d at, double luminance,
                       std::uint32_t power) {
    return RenderLight{.name = name,
                       .field = name,
                       .light = lights::Light::point,
                       .parameters = {0, at.x(), at.y(), at.z()},
                       .reference_distance = 0,
                       .luminance = luminance,
                       .solid_angle = std::numbers::pi,
                       .emission = power};
  };
  scene.lights = {lamp("left", {-1.5, 2.5, 1}, 0.7, 0), lamp("right", {1.8, 1.6, -0.5}, 0.5, 1)};

  scene.properties = {Spectrum{{550}, {1}}};
  scene.property_fields = {"material[0].specular"};
  for (unsigned i = 0; i < stripes; ++i) {
    const auto& name = cie::test_color_names()[i];
    scene.properties.push_back(*cie::test_color(name));
    scene.property_fields.push_back("material[" + std::to_string(i) + "].diffuse");
    const bool shiny = i % 2 == 1;
    RenderMaterial material{.name = name,
                            .reflection = {},
                            .fresnel = FresnelKind::none,
                            .constants = 0,
                            .diffuse = i + 1,
                            .specular = 0,
                            .mirror = mirrors && shiny ? 0.3f : 0.0f};
    material.reflection.model = shiny ? models::Model::blinn_phong : models::Model::lambert;
    material.reflection.parameters = {0.8f, shiny ? 0.3f : 0.0f, 60.0f};
    scene.materials.push_back(std::move(material));
    scene.meshes.push_back(stripe(-2 + 4.0 * i / stripes, 4.0 / stripes, side / stripes, side));
    scene.objects.push_back(
        {name, RenderObject::Shape::mesh, i, i, v1::PHONG, Eigen::Affine3d::Identity()});
  }
  return scene;
}

v1::Plan make_plan(const RenderScene& scene, unsigned spp) {
  v1::Plan plan;
  plan.set_width(320);
  plan.set_height(240);
  plan.set_tile_size(16);
  plan.set_spp(spp);
  plan.set_threads(1);
  bool mirrors = false;
  for (const RenderMaterial& material : scene.materials) mirrors |= material.mirror > 0;
  plan.set_depth(mirrors ? 3 : 0);
  return plan;
}

v1::Method point_method(unsigned samples) {
  v1::Method method;
  method.mutable_point()->set_from(400);
  method.mutable_point()->set_to(700);
  method.mutable_point()->set_step(300.0 / (samples - 1));
  return method;
}

v1::Method rgb_method() {
  v1::Method method;
  method.mutable_rgb();
  return method;
}

}  // namespace metamer::bench
