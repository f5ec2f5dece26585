#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/problem.h"
#include "common/scene/validate.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// A scene on its way from the message to the arrays, with what is wrong with it.
struct Compiling {
  const v1::Scene& scene;
  const AssetReader& assets;
  RenderScene result = {};
  std::vector<Problem> problems = {};

  void add(std::string field, std::string message) {
    problems.push_back({.field = std::move(field), .file = {}, .message = std::move(message)});
  }
  void note(const std::vector<std::string>& notes, const std::string& field) {
    for (const std::string& message : notes) result.notices.push_back({field, message});
  }
};

}  // namespace metamer
