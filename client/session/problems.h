#pragma once

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
          .message = problem.message(),
          .was = problem.was(),
          .meant = problem.meant()};
}

/// The same of a message's list, or of a SessionError's.
template <class Problems>
std::vector<Problem> from_wire(const Problems& problems) {
  std::vector<Problem> result;
  for (const v1::Problem& one : problems) result.push_back(from_wire(one));
  return result;
}

}  // namespace metamer::client
