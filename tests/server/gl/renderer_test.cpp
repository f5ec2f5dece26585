#include "server/gl/passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>

#include "tests/server/gl/context_test.h"
#include "tests/server/gl/pictures.h"
#include "tests/server/methods/methods.h"

namespace metamer::gl {
namespace {

constexpr v1::Shading shadings[] = {v1::PHONG, v1::CONSTANT, v1::GOURAUD, v1::QUADRATIC};

/// The gallery, its balls as meshes where a shading interpolates over triangles.
SceneOnDisk gallery(v1::Shading shading) {
  SceneOnDisk scene = read_deployed("gallery/gallery.txtpb");
  v1::Settings& settings = *scene.message.mutable_settings();
  // Facets of one colour each have to be larger than pixels.
  const bool facets = shading == v1::CONSTANT;
  settings.set_width(facets ? 900 : 300);
  settings.set_height(facets ? 450 : 150);
  settings.set_spp(facets ? 1 : 4);
  for (v1::Object& object : *scene.message.mutable_object()) {
    object.clear_shading();
    if (shading == v1::PHONG || !object.has_sphere()) continue;
    const v1::Sphere ball = object.sphere();
    object.mutable_mesh()->set_file("meshes/coarse-ball.ply");
    object.set_shading(shading);
    v1::Vec3& scale = *object.add_transform()->mutable_scale();
    scale.set_x(ball.radius());
    scale.set_y(ball.radius());
    scale.set_z(ball.radius());
    *object.add_transform()->mutable_translate() = ball.center();
  }
  return scene;
}

struct NamedMethod {
  const char* name;
  v1::Method method;
};

std::vector<NamedMethod> methods() {
  return {{"point", test::uniform(400, 700, 5)},
          {"fitted", test::fitted(8)},
          {"rgb", test::rgb()},
          {"prefilter", test::prefilter()},
          {"linear", test::linear(4, v1::Linear::OBSERVER, true)},
          {"exact", test::exact()}};
}

/// What a share of the values does not exceed.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = std::min(values.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

/// The table of agreement: beside the programs, or where METAMER_REPORT says.
class Report {
 public:
  Report() {
    const char* wanted = std::getenv("METAMER_REPORT");
    out_.open(wanted ? wanted : METAMER_BIN "/../gl.md");
    out_ << "# The GL backend beside the CPU\n\nΔE00 between their pictures of the gallery, "
            "without "
            "mirrors, over the pixels that lie on no silhouette and on no shadow's edge: median / "
            "99.9 % / maximum.\nWritten by a test (`tests/server/gl/renderer_test.cpp`).\n\n"
            "| shading | method | model | pixels | median | 99.9 % | maximum |\n"
            "|---|---|---|---|---|---|---|\n";
  }
  void add(const std::string& shading, const std::string& method, const std::string& model,
           const std::vector<double>& errors) {
    out_ << "| " << shading << " | " << method << " | " << model << " | " << errors.size() << " | "
         << quantile(errors, 0.5) << " | " << quantile(errors, 0.999) << " | "
         << quantile(errors, 1) << " |\n";
  }
  bool is_written() {
    out_.close();
    return bool(out_);
  }

 private:
  std::ofstream out_;
};

/// The differences of smooth pixels, by the model that they show.
std::map<std::string, std::vector<double>> by_model(const Pictures& pictures,
                                                    const std::vector<double>& differences) {
  std::map<std::string, std::vector<double>> result;
  const RenderScene& scene = pictures.scene();
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const int object = pictures.objects()[i];
    if (!pictures.smooth()[i] || object < 0) continue;
    const RenderMaterial& material =
        scene.materials[scene.objects[static_cast<std::size_t>(object)].material];
    result[models::entry(material.reflection.model).name].push_back(differences[i]);
  }
  return result;
}

class GlRenderer : public ContextTest {};

TEST_F(GlRenderer, AgreesWithTheCpuForEveryModelShadingAndMethod) {
  Report report;
  ProgramCache programs;
  for (const v1::Shading shading : shadings) {
    const Pictures pictures(gallery(shading));
    for (const auto& [name, method] : methods()) {
      const auto gl = pictures.by_gl(method, programs);
      ASSERT_TRUE(gl) << gl.error().message;
      const auto models = by_model(pictures, pictures.differences(pictures.by_cpu(method), *gl));
      EXPECT_EQ(models.size(), models::registry(models::Kind::model).size());
      for (const auto& [model, errors] : models) {
        SCOPED_TRACE(v1::Shading_Name(shading) + " " + name + " " + model);
        EXPECT_GT(errors.size(), 90u);
        EXPECT_LE(quantile(errors, 0.5), 0.02);
        EXPECT_LE(quantile(errors, 0.999), 0.5);
        report.add(v1::Shading_Name(shading), name, model, errors);
      }
    }
  }
  EXPECT_TRUE(report.is_written());
}

// Two lights and so many boxes that one shader for both lights runs into llvmpipe's limit of loops,
// where blocks of pixels are at an edge.
TEST_F(GlRenderer, MultiplePassesGiveTheBoothAsOnePassDoes) {
  SceneOnDisk booth = read_deployed("booth/booth.txtpb");
  booth.message.mutable_settings()->set_width(80);
  booth.message.mutable_settings()->set_height(60);
  booth.message.mutable_settings()->set_spp(1);
  const Pictures pictures(booth);
  ProgramCache programs;
  v1::Method method = test::uniform(400, 700, 100);
  const auto one = pictures.by_gl(method, programs);
  method.mutable_point()->set_multi_pass(true);
  const auto many = pictures.by_gl(method, programs);
  ASSERT_TRUE(one && many);
  const float brightest = *std::max_element(one->begin(), one->end());
  EXPECT_GT(brightest, 0.1f);
  for (std::size_t i = 0; i < one->size(); ++i)
    ASSERT_NEAR((*one)[i], (*many)[i], 1e-5f * brightest) << i;
}

}  // namespace
}  // namespace metamer::gl
