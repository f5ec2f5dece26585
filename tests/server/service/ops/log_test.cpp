// What a line of the log looks like, whatever is cited in it.

#include "server/service/ops/log.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "../client.h"
#include "../program.h"
#include "server/service/ops/folders.h"

namespace metamer::service::test {

namespace {

constexpr const char* hostile = "x\n[error] \"forged\" job=8\x1b[2J\\";

class Log : public testing::Test {
 protected:
  TemporaryFolder folder_ = TemporaryFolder::make().value();

  /// The log of a daemon whose client has a hostile name and a hostile job, which its worker loses.
  std::string log_of(std::vector<std::string> options, std::vector<std::string> environment = {}) {
    const auto path = folder_.path() / "socket";
    options.insert(options.end(), {"--listen", "unix:" + path.string(), "--parent-fd", "3"});
    Program program(folder_.path(), options, std::move(environment));
    EXPECT_EQ(program.ready(), "ready\n");
    Client client(path);
    v1::Envelope message;
    message.mutable_hello()->set_protocol_version(1);
    message.mutable_hello()->set_client(hostile);
    EXPECT_TRUE(client.ask(message).has_welcome());
    message.mutable_submit()->set_scene_sha256(client.upload({"picture 8 8 8"})[0]);
    message.mutable_submit()->set_name(hostile);
    job_ = client.ask(message).submitted().job_id();
    client.watch(job_);
    client.receive_event_until([](auto& event) { return event.has_finished(); });
    // Its worker dies once, in the middle of it.
    client.watch(client.submit("once crash 5 picture 64 48 16"));
    client.receive_event_until([](auto& event) { return event.has_finished(); });
    program.signal(SIGTERM);
    EXPECT_EQ(program.wait(), 0);
    return program.log();
  }
  static std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> result;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) result.push_back(line);
    return result;
  }

  std::uint64_t job_ = 0;
};

}  // namespace

TEST_F(Log, EachLineOfTextHasItsTimeAndItsLevelAndFieldsAfterTheMessage) {
  const std::regex shape(R"(\[\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3}\] \[metamerd\] \[[a-z]+\] .*)");
  bool named = false, explained = false;
  for (const std::string& line : lines(log_of({}))) {
    EXPECT_TRUE(std::regex_match(line, shape)) << line;
    named |= line.ends_with(" job=" + std::to_string(job_));
    EXPECT_EQ(line.find('\x1b'), std::string::npos);
    explained |= line.ends_with(" job=" + std::to_string(job_ + 1) +
                                " reason=\"killed by signal 6 (Aborted)\"");
  }
  EXPECT_TRUE(named);
  EXPECT_TRUE(explained);
}

TEST_F(Log, EachLineOfJsonIsAnObjectWithTheSameFields) {
  bool named = false, came = false;
  for (const std::string& line : lines(log_of({"--log-format", "json"}))) {
    const auto object = nlohmann::json::parse(line, nullptr, false);
    ASSERT_TRUE(object.is_object()) << line;
    EXPECT_TRUE(std::regex_match(object["time"].get<std::string>(),
                                 std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)")));
    EXPECT_TRUE(object["level"].is_string());
    EXPECT_TRUE(object["message"].is_string());
    named |= object.contains("job") && object["job"] == job_;
    came |= object["message"].get<std::string>().starts_with("admin says hello") &&
            object["user"] == object["peer"] &&
            object["peer"].get<std::string>().starts_with("uid ");
  }
  EXPECT_TRUE(named);
  EXPECT_TRUE(came);
}

TEST_F(Log, TheJournalGetsPrioritiesInsteadOfTimes) {
  std::ofstream(folder_.path() / "log").flush();
  struct stat status {};
  ASSERT_EQ(::stat((folder_.path() / "log").c_str(), &status), 0);
  const std::string stream =
      "JOURNAL_STREAM=" + std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
  for (const std::string& line : lines(log_of({}, {stream})))
    EXPECT_TRUE(std::regex_match(line, std::regex("<[2-7]>[^\\[].*"))) << line;
  // Of another stream it is not.
  EXPECT_TRUE(log_of({}, {"JOURNAL_STREAM=1:1"}).starts_with("["));
}

}  // namespace metamer::service::test
