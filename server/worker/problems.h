#pragma once

#include <vector>

#include "common/problem.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/problem.pb.h"

namespace metamer::worker {

/// One problem as a message, cut to what people read; bytes that are no UTF-8 become '?'.
void set_problem(const Problem& problem, v1::Problem& to);

/// What is wrong with a scene, as messages; the first hundred of them.
void add_problems(const std::vector<Problem>& problems,
                  google::protobuf::RepeatedPtrField<v1::Problem>& to);

/// Why a job or view has failed.
v1::Failed failed_for(v1::Failed::Kind kind, const std::string& reason);

/// The same of a scene with one problem or more: Kind SERVER where one of them is_damage(), else
/// BAD_INPUT. One that has no place is the reason.
v1::Failed failed_for(const std::vector<Problem>& problems);

}  // namespace metamer::worker
