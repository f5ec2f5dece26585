// Jobs as people name them: no command asks a server for another one's.
#include <gtest/gtest.h>

#include "said.h"
#include "tests/client/session/fake_server.h"

namespace metamer::cli {
namespace {

using test::FakeServer;

constexpr const char* handle = "7@61616161";
constexpr const char* others = "7@62626262";

/// Answers each request about job 7, which is finished, and keeps what it was asked.
struct Server {
  std::vector<v1::Envelope::BodyCase> asked;

  std::vector<v1::Envelope> operator()(const v1::Envelope& request) {
    v1::Envelope answer;
    if (request.has_hello()) {
      answer = test::welcome();
      answer.mutable_welcome()->set_server_id(std::string(16, 'a'));
      return {answer};
    }
    asked.push_back(request.body_case());
    if (request.has_list_jobs()) answer.mutable_job_list()->add_job()->set_job_id(7);
    if (request.has_watch()) answer = test::last_event(1);
    if (request.has_watch()) answer.mutable_job_event()->set_job_id(7);
    if (answer.body_case() == v1::Envelope::BODY_NOT_SET)
      answer.mutable_job_summary()->set_job_id(7);
    return {answer};
  }
};

using Words = std::vector<std::string>;

/// What each command that takes a job says of the one that is named so.
std::vector<Words> commands_on(const std::string& job) {
  return {{"fetch", job, "-o", "never.png"},
          {"watch", job},
          {"cancel", job},
          {"cancel", "1", job},
          {"pause", job},
          {"resume", job},
          {"priority", job, "5"}};
}

TEST(NamedJob, OfAnotherServerIsAnErrorBeforeAnythingIsAsked) {
  Server answers;
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    for (Words words : commands_on(others)) {
      words.insert(words.end(), {"--server", address});
      const Said said = say(words);
      EXPECT_EQ(said.code, ExitCode::bad_input) << words[0];
      EXPECT_EQ(said.err,
                "error: job 7@62626262 is of another server: this one's end in @61616161\n");
    }
  });
  EXPECT_TRUE(answers.asked.empty());
}

TEST(NamedJob, IsFoundByItsHandleAndByItsNumber) {
  for (const std::string job : {"7", handle, "7@61616161616161616161616161616161"}) {
    Server answers;
    FakeServer server([&](const v1::Envelope& request) { return answers(request); });
    server.beside([&](const std::string& address) {
      for (Words words : commands_on(job)) {
        words.insert(words.end(), {"--server", address});
        const Said said = say(words);
        const bool watches = words[0] == "fetch" || words[0] == "watch";
        EXPECT_EQ(said.code, watches ? ExitCode::cancelled : ExitCode::done)
            << words[0] << ": " << said.err;
      }
    });
    EXPECT_EQ(answers.asked.size(), commands_on(job).size() + 2)
        << "fetch asks for its name too, and one cancels two";
  }
}

TEST(NamedJob, ByWordsThatAreNoneIsAnErrorWithoutAServer) {
  for (Words words : commands_on("7@x")) {
    words.insert(words.end(), {"--server", "unix:/nobody/listens/here"});
    const Said said = say(words);
    EXPECT_EQ(said.code, ExitCode::bad_input) << words[0];
    EXPECT_NE(said.err.find("\"7@x\" is no job"), std::string::npos) << said.err;
  }
}

TEST(NamedJob, MayBeASeriesWhereSeveralAreTaken) {
  Server answers;
  FakeServer server([&](const v1::Envelope& request) {
    std::vector<v1::Envelope> said = answers(request);
    if (!request.has_list_jobs()) return said;
    // Of its three jobs the first has ended.
    v1::JobList& list = *said[0].mutable_job_list();
    list.clear_job();
    for (std::uint64_t id = 1; id <= 3; ++id) {
      v1::JobSummary& job = *list.add_job();
      job.set_job_id(id);
      job.set_state(id == 1 ? v1::FINISHED : v1::QUEUED);
      job.mutable_series()->set_id(std::string(16, 's'));
      job.mutable_series()->set_name("three");
      job.mutable_series()->set_count(3);
      job.mutable_series()->set_index(static_cast<std::uint32_t>(id - 1));
    }
    return said;
  });
  server.beside([&](const std::string& address) {
    for (Words words : commands_on("series:73737373")) {
      answers.asked.clear();
      words.insert(words.end(), {"--server", address});
      const Said said = say(words);
      const bool takes_one = words[0] == "watch" || words[0] == "fetch";
      EXPECT_EQ(said.code, takes_one ? ExitCode::bad_input : ExitCode::done)
          << words[0] << ": " << said.err;
      const std::size_t others = words.size() == 5 && words[0] == "cancel" ? 1 : 0;
      EXPECT_EQ(answers.asked.size(), takes_one ? 0 : 1 + 2 + others) << words[0];
    }
    const auto paused = say({"pause", "series:three", "--json", "--server", address}).json();
    EXPECT_EQ(paused["jobs"].size(), 2u);
    EXPECT_EQ(say({"pause", "series:four", "--server", address}).err,
              "error: no series \"four\" has jobs that are listed here\n");
  });
}

TEST(NamedJob, HasItsRecordOnceItHasFinished) {
  bool finished = false;
  FakeServer server([&](const v1::Envelope& request) -> std::vector<v1::Envelope> {
    v1::Envelope answer = test::welcome();
    if (request.has_list_jobs()) {
      v1::JobSummary& job = *answer.mutable_job_list()->add_job();
      job.set_job_id(7);
      job.set_state(finished ? v1::FINISHED : v1::RUNNING);
    }
    if (request.has_watch()) {
      answer.mutable_job_event()->set_job_id(7);
      v1::RunRecord& record = *answer.mutable_job_event()->mutable_finished()->mutable_record();
      record.set_build("abc");
      record.add_machine()->set_tiles(12);
    }
    return {answer};
  });
  server.beside([&](const std::string& address) {
    EXPECT_EQ(say({"jobs", "--record", "7", "--server", address}).err,
              "error: a job has its record once it has finished; this one is running\n");
    finished = true;
    const auto answer = say({"jobs", "--record", "7", "--json", "--server", address}).json();
    EXPECT_EQ(answer["record"]["build"], "abc");
    EXPECT_EQ(answer["record"]["machine"][0]["tiles"], 12);
    EXPECT_EQ(answer["exit_code"], 0);
  });
}

TEST(NamedJob, IsListedAsItIsNamed) {
  Server answers;
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    EXPECT_NE(say({"jobs", "--server", address}).out.find(handle), std::string::npos);
    const auto listed = say({"jobs", "--json", "--server", address}).json();
    EXPECT_EQ(listed["server_id"], "61616161616161616161616161616161");
    EXPECT_EQ(listed["jobs"][0]["job_id"], 7);
    EXPECT_EQ(listed["jobs"][0]["handle"], handle);
    const auto event = say({"watch", "7", "--json", "--server", address}).json();
    EXPECT_EQ(event["job_id"], 7);
    EXPECT_EQ(event["handle"], handle);
    EXPECT_EQ(event["server_id"], listed["server_id"]);
    const auto paused = say({"pause", handle, "--json", "--server", address}).json();
    EXPECT_EQ(paused["job"]["handle"], handle);
  });
}

}  // namespace
}  // namespace metamer::cli
