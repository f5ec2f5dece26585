// The table of job_state.h, cell by cell.

#include "server/service/jobs/job_state.h"

#include <gtest/gtest.h>

#include <map>

namespace metamer::service {

namespace {

constexpr v1::JobState states[] = {v1::QUEUED,   v1::RUNNING, v1::PAUSED,
                                   v1::FINISHED, v1::FAILED,  v1::CANCELLED};
constexpr Step steps[] = {Step::start,  Step::retry,  Step::yield, Step::pause,
                          Step::resume, Step::finish, Step::fail,  Step::cancel};

const std::map<std::pair<v1::JobState, Step>, v1::JobState> allowed = {
    {{v1::QUEUED, Step::start}, v1::RUNNING},    {{v1::QUEUED, Step::pause}, v1::PAUSED},
    {{v1::QUEUED, Step::fail}, v1::FAILED},      {{v1::QUEUED, Step::cancel}, v1::CANCELLED},
    {{v1::RUNNING, Step::retry}, v1::QUEUED},    {{v1::RUNNING, Step::pause}, v1::PAUSED},
    {{v1::RUNNING, Step::finish}, v1::FINISHED}, {{v1::RUNNING, Step::fail}, v1::FAILED},
    {{v1::RUNNING, Step::yield}, v1::QUEUED},    {{v1::RUNNING, Step::cancel}, v1::CANCELLED},
    {{v1::PAUSED, Step::resume}, v1::QUEUED},    {{v1::PAUSED, Step::cancel}, v1::CANCELLED},
};

}  // namespace

TEST(JobState, EveryStepInEveryStateIsAsTheTableSays) {
  for (const v1::JobState state : states) {
    for (const Step step : steps) {
      const auto expected = allowed.find({state, step});
      const auto next = next_state(state, step);
      EXPECT_EQ(next.has_value(), expected != allowed.end())
          << word(state) << ", step " << static_cast<int>(step);
      if (next && expected != allowed.end()) {
        EXPECT_EQ(*next, expected->second) << word(state) << ", step " << static_cast<int>(step);
      }
    }
  }
}

TEST(JobState, AnEndHasNoWayOut) {
  for (const v1::JobState state : states) {
    bool way_out = false;
    for (const Step step : steps) way_out = way_out || next_state(state, step).has_value();
    EXPECT_EQ(is_end(state), !way_out) << word(state);
  }
}

}  // namespace metamer::service
