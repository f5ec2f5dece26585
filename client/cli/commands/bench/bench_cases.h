#pragma once

#include <string>
#include <vector>

#include "client/session/submission.h"
#include "common/models/registry.h"
#include "metamer/v1/scene.pb.h"
#include "metamer/v1/session.pb.h"

namespace metamer::cli {

/// One scene that `metamer bench` measures.
struct BenchCase {
  std::string name;
  v1::Scene scene;
  std::vector<client::Upload> meshes = {};  ///< By the names that the scene has for them.
};

/// The same scene with each model of models.def, Blinn–Phong first; then the models with a Fresnel
/// term with an exact one, and Lambert with each diffuse term.
std::vector<BenchCase> model_cases();

/// The same scene by each method, rgb first; with `multi_pass` those of point also so.
std::vector<BenchCase> method_cases(bool multi_pass);

/// The same scene of meshes by one method: `points` wavelengths, 0: rgb. With a model and a kind of
/// shading each.
BenchCase shading_case(const models::Entry& model, v1::Shading shading, std::uint32_t points,
                       bool multi_pass);

/// What such a scene is, in words.
std::string bench_scene_text(const v1::Scene& scene, const v1::Capabilities& capabilities);

}  // namespace metamer::cli
