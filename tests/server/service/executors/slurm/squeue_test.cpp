// What squeue says is made by whoever may submit jobs: it is read within bounds.
#include "server/service/executors/slurm/squeue.h"

#include <gtest/gtest.h>

namespace metamer::service {
namespace {

using State = ListedTask::State;

std::string jobs_of(const std::string& list) {
  return R"({"meta":{"plugin":{"type":"openapi"},"jobs":[{"name":"mm-no"}]},"errors":[],"jobs":[)" +
         list + "]}";
}

// As Slurm 22.05.8 says it, cut to what matters.
TEST(Squeue, IsReadAsOfSlurm22) {
  const auto tasks = read_squeue(
      jobs_of(R"({"account":"","array_job_id":1,"array_task_id":3,"array_task_string":"",
                  "job_resources":{"nodes":"x","allocated_nodes":{"0":{"name":"mm-z"}}},
                  "job_state":"RUNNING","name":"mm-a","nodes":"n2","tres_req_str":null},
                 {"array_task_id":null,"array_task_string":"4-9","job_state":"PENDING",
                  "name":"mm-a","nodes":""},
                 {"array_task_id":4294967294,"array_task_string":"","job_state":"PENDING",
                  "name":"other","nodes":""})"),
      "mm-");
  ASSERT_TRUE(tasks) << tasks.error().message;
  ASSERT_EQ(tasks->size(), 2u);
  EXPECT_EQ((*tasks)[0].name, "mm-a");
  EXPECT_EQ((*tasks)[0].index, 3u);
  EXPECT_EQ((*tasks)[0].state, State::running);
  EXPECT_EQ((*tasks)[0].node, "n2");
  EXPECT_FALSE((*tasks)[1].index);
  EXPECT_EQ((*tasks)[1].state, State::waiting);
}

// As data_parser v0.0.40 says it (Slurm 23.11).
TEST(Squeue, IsReadAsOfSlurm23) {
  const auto tasks = read_squeue(
      jobs_of(R"({"array_task_id":{"set":true,"infinite":false,"number":5},"array_task_string":"",
                  "job_state":["NODE_FAIL"],"name":"mm-a","nodes":"n1"},
                 {"array_task_id":{"set":false,"infinite":false,"number":0},
                  "array_task_string":"6-7","job_state":["PENDING"],"name":"mm-a","nodes":""})"),
      "mm-");
  ASSERT_TRUE(tasks) << tasks.error().message;
  ASSERT_EQ(tasks->size(), 2u);
  EXPECT_EQ((*tasks)[0].index, 5u);
  EXPECT_EQ((*tasks)[0].word, "NODE_FAIL");
  EXPECT_EQ((*tasks)[0].state, State::ended);
  EXPECT_FALSE((*tasks)[1].index);
}

TEST(Squeue, ThatIsNoListingIsAnError) {
  for (const char* text : {"", "{", "[]", "{}", "nonsense", R"({"jobs":{}})", R"({"jobs":[)",
                           R"({"jobs":[{"name":"mm-a")"})
    EXPECT_FALSE(read_squeue(text, "mm-")) << text;
  EXPECT_TRUE(read_squeue(R"({"jobs":[]})", "mm-"));
}

TEST(Squeue, NestedOrLongBeyondAllReasonIsAnErrorAndTakesNoMemory) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "[";
  const auto nested = read_squeue(jobs_of(R"({"name":)" + deep), "mm-");
  ASSERT_FALSE(nested);
  EXPECT_EQ(nested.error().message, "what squeue says is nested too deep");

  std::string many;
  for (std::size_t i = 0; i <= max_listed; ++i) many += R"({"name":"mm-a"},)";
  const auto listed = read_squeue(jobs_of(many), "mm-");
  ASSERT_FALSE(listed);
  EXPECT_EQ(listed.error().message, "what squeue says lists more tasks than can be ours");
}

TEST(Squeue, TextsAreShortAndCommandNoTerminal) {
  const auto tasks =
      read_squeue(jobs_of(R"({"name":"mm-a","nodes":"\u001b[31m)" + std::string(1000, 'n') + R"(",
                  "job_state":"WHO\u0007KNOWS","array_task_id":-1},
                 {"name":"mm-)" +
                          std::string(1000, 'x') + R"("})"),
                  "mm-");
  ASSERT_TRUE(tasks);
  ASSERT_EQ(tasks->size(), 1u);
  EXPECT_EQ(tasks->at(0).node.substr(0, 6), "?[31mn");
  EXPECT_EQ(tasks->at(0).node.size(), 128u);
  EXPECT_EQ(tasks->at(0).word, "WHO?KNOWS");
  EXPECT_EQ(tasks->at(0).state, State::running);  // for all that anybody knows
  EXPECT_FALSE(tasks->at(0).index);
}

}  // namespace
}  // namespace metamer::service
