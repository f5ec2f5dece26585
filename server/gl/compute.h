#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/gl/program.h"

namespace metamer::gl {

/// A compute shader from floats to floats: it reads the buffer at binding 0 and writes that at
/// binding 1. Needs a current Context, also to be destroyed.
class Compute {
 public:
  /// The compiler's words where it refuses the source.
  static Result<Compute> compile(const std::string& source);

  /// Runs so many groups and waits for the `outputs` numbers that they wrote.
  Result<std::vector<float>> run(std::span<const float> inputs, std::size_t outputs,
                                 unsigned groups) const;

 private:
  explicit Compute(Program program) : program_(std::move(program)) {}

  Program program_;
};

}  // namespace metamer::gl
