#pragma once

#include <vector>

#include "common/problem.h"
#include "metamer/v1/problem.pb.h"

namespace metamer::worker {

/// One problem as a message, cut to what people read; bytes that are no UTF-8 become '?'.
void set_problem(const Problem& problem, v1::Problem& to);

/// What is wrong with a scene, as messages; the first hundred of them.
void add_problems(const std::vector<Problem>& problems,
                  google::protobuf::RepeatedPtrField<v1::Problem>& to);

}  // namespace metamer::worker
