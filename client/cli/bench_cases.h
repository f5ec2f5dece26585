#pragma once

#include <string>
#include <vector>

#include "metamer/v1/scene.pb.h"

namespace metamer::cli {

/// One row of `metamer bench`.
struct BenchCase {
  std::string name;
  v1::Scene scene;
};

/// The same scene with each model of models.def, Blinn–Phong first; then the models with a Fresnel
/// term with an exact one, and Lambert with each diffuse term.
std::vector<BenchCase> model_cases();

/// The same scene by each method, rgb first; with `multi_pass` those of point also so.
std::vector<BenchCase> method_cases(bool multi_pass);

/// What such a scene is, in words.
std::string bench_scene_text(const v1::Scene& scene);

}  // namespace metamer::cli
