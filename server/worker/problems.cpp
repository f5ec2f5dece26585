#include "server/worker/problems.h"

namespace metamer::worker {

void add_problems(const std::vector<Problem>& problems,
                  google::protobuf::RepeatedPtrField<v1::Problem>& to) {
  // A hostile scene can have more problems than a frame holds; nobody reads the 101st.
  for (std::size_t i = 0; i < problems.size() && i < 100; ++i) {
    v1::Problem& problem = *to.Add();
    problem.set_field(problems[i].field.substr(0, 500));
    problem.set_file(problems[i].file.substr(0, 500));
    problem.set_line(static_cast<std::uint32_t>(problems[i].line));
    problem.set_column(static_cast<std::uint32_t>(problems[i].column));
    problem.set_message(problems[i].message.substr(0, 1000));
  }
}

}  // namespace metamer::worker
