#pragma once

#include <vector>

#include "common/problem.h"
#include "metamer/v1/problem.pb.h"

namespace metamer::worker {

/// What is wrong with a scene, as messages; the first hundred of them.
void add_problems(const std::vector<Problem>& problems,
                  google::protobuf::RepeatedPtrField<v1::Problem>& to);

}  // namespace metamer::worker
