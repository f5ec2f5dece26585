#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <vector>

#include "common/problem.h"
#include "metamer/v1/problem.pb.h"

namespace metamer::client {

/// A problem as it came over the wire.
inline Problem from_wire(const v1::Problem& problem) {
  return {.field = problem.field(),
          .file = problem.file(),
          .line = static_cast<int>(problem.line()),
          .column = static_cast<int>(problem.column()),
          .message = problem.message()};
}

inline std::vector<Problem> from_wire(
    const google::protobuf::RepeatedPtrField<v1::Problem>& problems) {
  std::vector<Problem> result;
  for (const v1::Problem& one : problems) result.push_back(from_wire(one));
  return result;
}

}  // namespace metamer::client
