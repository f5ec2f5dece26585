#pragma once

#include <map>
#include <memory>

#include "server/gl/compute.h"
#include "server/gl/context.h"
#include "tests/extremes/builds.h"

namespace metamer::extremes {

/// Build::glsl: the shared sources as compute shaders, one for each form.
class GlBuild {
 public:
  static Result<GlBuild> create();

  Result<Values> evaluate(const std::vector<Row>& rows);
  const std::string& renderer() const { return context_->renderer(); }

 private:
  explicit GlBuild(gl::Context context)
      : context_(std::make_unique<gl::Context>(std::move(context))) {}
  Result<const gl::Compute*> program(const Row& row);

  std::unique_ptr<gl::Context> context_;  // Outlives the programs.
  std::map<std::string, gl::Compute> programs_;
};

}  // namespace metamer::extremes
