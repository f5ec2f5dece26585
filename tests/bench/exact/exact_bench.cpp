// What `exact` costs over `rgb` among mirrors with Fresnel terms: CPU time of one thread, the least
// of several turns that take each other's place.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <tuple>

#include "common/scene/settings.h"
#include "server/cpu/tracer.h"
#include "server/plan/plan.h"
#include "tests/server/test_scene.h"

namespace {

using namespace metamer;

struct Case {
  const char* mirror;  ///< Its Fresnel term, as a scene has it.
  unsigned lights, materials;
  const char* paint;  ///< What all paints have beside diffuse.
};

constexpr const char* glow =
    "fluorescence { excitation { samples { wavelength: [300, 370, 420] value: [0.1, 0.5, 0] } } "
    "emission { samples { wavelength: [410, 450, 560] value: [0, 1, 0] } } quantum_yield: 0.8 }";

std::string number(double value) { return std::to_string(value); }

/// Matt and shiny balls before a mirror, and on another.
std::string scene_text(const Case& of) {
  const char* spectra[] = {"D65", "F11", "A", "F2"};
  std::string text = "camera { eye { y: 1 z: 6 } target { y: 0.5 } } ";
  for (unsigned i = 0; i < of.lights; ++i)
    text += "light { name: 'l" + std::to_string(i) + "' position { x: " + number(i % 8 - 4.0) +
            " y: 4 z: " + number(1.0 + i / 8) + " } spectrum { standard: '" + spectra[i % 4] +
            "' } luminance: " + number(1.0 / of.lights) + " } ";
  text += std::string("material { name: 'mirror' mirror: 0.9 ") + of.mirror + " } ";
  const double radius = 0.5 / std::cbrt(of.materials);
  const auto scattered = [](unsigned i, double step, double width) {
    return number(width * (i * step - std::floor(i * step)) - width / 2);
  };
  for (unsigned i = 0; i < of.materials; ++i) {
    const std::string name = std::to_string(i);
    text += "material { name: 'p" + name + "' diffuse { samples { wavelength: [400, " +
            std::to_string(420 + i * 37 % 260) + ", 700] value: [0.1, 0.8, " +
            number(i % 10 / 10.0) + "] } } " + of.paint +
            " blinn_phong { shininess: 20 } specularness: 0.2 } object { name: 'o" + name +
            "' material: 'p" + name + "' sphere { center { x: " + scattered(i, 0.618, 6) +
            " y: " + scattered(i, 0.414, 3) + " z: " + scattered(i, 0.732, 4) +
            " } radius: " + number(radius) + " } } ";
  }
  return text +
         "object { name: 'f' material: 'mirror' quad { corner { x: -5 y: -1.5 z: -5 } u { z: 11 } "
         "v { x: 10 } } } object { name: 'w' material: 'mirror' quad { corner { x: -5 y: -1.5 z: "
         "-3 "
         "} u { x: 10 } v { y: 6 } } }";
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A picture of a scene by one method.
class Turn {
 public:
  Turn(const RenderScene& scene, const cpu::EmbreeScene& geometry, unsigned depth,
       const v1::Method& method)
      : plan_(plan(scene, depth, method)),
        method_(make_method(plan_, scene)),
        tracer_(scene, geometry, plan_),
        pixels_(std::size_t{plan_.width()} * plan_.height() * 3) {}

  /// Renders it; keeps the least time.
  void take() {
    auto workspace = tracer_.make_workspace();
    const Film film{pixels_.data(), plan_.width(), plan_.height()};
    FilmSink sink(*method_, film, plan_.spp());
    const double start = cpu_seconds();
    tracer_.render({0, 0, plan_.width(), plan_.height()}, sink, workspace, never_, work_);
    least_ = std::min(least_, cpu_seconds() - start);
  }
  double least() const { return least_; }

 private:
  static v1::Plan plan(const RenderScene& scene, unsigned depth, const v1::Method& method) {
    v1::Settings settings;
    const unsigned height = scene.lights.size() > 8 ? 48 : 120;
    settings.set_width(height * 4 / 3);
    settings.set_height(height);
    settings.set_spp(4);
    settings.set_depth(depth);
    *settings.mutable_method() = method;
    return make_plan(scene, with_defaults(settings), {.threads = 1});
  }

  std::atomic<bool> never_ = false;
  std::atomic<std::uint64_t> work_ = 0;
  v1::Plan plan_;
  std::unique_ptr<Method> method_;
  cpu::Tracer tracer_;
  std::vector<float> pixels_;
  double least_ = std::numeric_limits<double>::infinity();
};

double ratio(const RenderScene& scene, const cpu::EmbreeScene& geometry, unsigned depth,
             unsigned turns) {
  v1::Method exact, rgb;
  exact.mutable_exact();
  rgb.mutable_rgb();
  Turn one(scene, geometry, depth, exact), other(scene, geometry, depth, rgb);
  for (unsigned i = 0; i < turns; ++i) {
    one.take();
    other.take();
  }
  return one.least() / other.least();
}

}  // namespace

int main(int count, char** arguments) {
  const unsigned turns = count > 1 ? static_cast<unsigned>(std::atoi(arguments[1])) : 5;
  const std::tuple<const char*, const char*, const char*> mirrors[] = {
      {"gold", "fresnel { conductor { metal: 'Au' } }", ""},
      {"copper", "fresnel { conductor { metal: 'Cu' } }", ""},
      {"glass", "fresnel { dielectric { medium: 'N-BK7' } }", ""},
      {"plain", "specular { samples { wavelength: [400, 560, 700] value: [0.3, 0.5, 0.9] } }", ""},
      {"glow", "fresnel { dielectric { medium: 'N-BK7' } }", glow}};
  const unsigned depths[] = {0, 1, 2, 4, 8, 16};
  std::printf("exact / rgb by depth%21s", "");
  for (const unsigned depth : depths) std::printf("%7u", depth);
  std::printf("\n");
  const std::atomic<bool> never = false;
  for (const auto& [name, mirror, paint] : mirrors)
    for (const unsigned lights : {1u, 8u, 64u})
      for (const unsigned materials : {1u, 10u, 1000u}) {
        const RenderScene scene =
            test::compile_text(scene_text({mirror, lights, materials, paint}));
        const auto geometry = cpu::EmbreeScene::build(scene, never);
        std::printf("%-8s %2u lights, %4u materials  ", name, lights, materials);
        for (const unsigned depth : depths) {
          std::printf("%7.3f", ratio(scene, *geometry, depth, turns));
          std::fflush(stdout);
        }
        std::printf("\n");
      }
}
