#include "tests/promises/measured_scene.h"

#include <chrono>

#include "common/scene/settings.h"
#include "server/cpu/tracer.h"
#include "server/scene/camera_space.h"
#include "tests/promises/plain_truth.h"
#include "tests/server/test_scene.h"

namespace metamer::promises {
namespace {

class TruthSink : public PixelSink {
 public:
  TruthSink(PlainTruth& truth, const v1::Settings& settings, std::vector<Lab>& to)
      : truth_(truth), settings_(settings), to_(to) {
    to_.resize(std::size_t{settings.width()} * settings.height());
  }
  void take(std::uint32_t x, std::uint32_t y, const Gather& gather) override {
    to_[std::size_t{y} * settings_.width() + x] =
        to_lab(truth_.resolve(gather, 1.0 / settings_.spp()), truth_.white());
  }

 private:
  PlainTruth& truth_;
  const v1::Settings& settings_;
  std::vector<Lab>& to_;
};

void trace_all(const PilotScene& pilot, const cpu::EmbreeScene& geometry, PixelSink& sink) {
  v1::Method method;
  method.mutable_rgb();
  const v1::Plan plan = plan_with(pilot, method);
  const cpu::Tracer tracer(pilot.scene, geometry, plan);
  auto workspace = tracer.make_workspace();
  tracer.render({0, 0, plan.width(), plan.height()}, sink, workspace, pilot.stopped, pilot.work);
}

}  // namespace

MeasuredScene::MeasuredScene(const VariedScene& scene)
    : scene_(to_camera_space(test::compile_text(scene.text))),
      settings_(with_defaults(test::parse_scene(scene.text).settings())),
      geometry_(std::make_shared<cpu::Geometry>(scene_, 1)),
      probe_(geometry_) {
  probe_.prepare(never_);
  PlainTruth truth(scene_, scene_.observer);
  white_ = truth.white();
  TruthSink sink(truth, settings_, truth_);
  trace_all(pilot(), geometry_->embree(), sink);
}

MeasuredScene::Rendered MeasuredScene::render(const v1::Method& method) {
  std::vector<float> xyz(truth_.size() * 3);
  const Film film{xyz.data(), settings_.width(), settings_.height()};
  const auto start = std::chrono::steady_clock::now();
  const auto prepared = make_method(plan_with(pilot(), method), scene_);
  FilmSink sink(*prepared, film, settings_.spp());
  trace_all(pilot(), geometry_->embree(), sink);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth_.size(); ++i)
    errors.push_back(
        delta_e_00(to_lab({xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}, white_), truth_[i]));
  return {seconds, summarize(errors)};
}

v1::Goal tolerance(double value) {
  v1::Goal goal;
  goal.set_tolerance(value);
  return goal;
}

}  // namespace metamer::promises
