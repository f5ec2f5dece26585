// What is counted, and the file of it: held against the format's grammar
// (https://prometheus.io/docs/instrumenting/exposition_formats).

#include "server/service/ops/metrics.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "../client.h"
#include "../daemon.h"
#include "../program.h"
#include "server/service/ops/folders.h"

namespace metamer::service::test {

namespace {

/// The samples of a text in the format 0.0.4, by name and labels; what breaks the grammar fails.
std::map<std::string, double> samples_of(const std::string& text) {
  static const std::regex help(R"(# HELP ([a-zA-Z_:][a-zA-Z0-9_:]*) ([^\n\\]|\\\\|\\n)*)");
  static const std::regex type(R"(# TYPE ([a-zA-Z_:][a-zA-Z0-9_:]*) (counter|gauge))");
  static const std::regex sample(
      R"re(([a-zA-Z_:][a-zA-Z0-9_:]*)(\{[a-zA-Z_][a-zA-Z0-9_]*="([^"\\\n]|\\[\\"n])*"(,[a-zA-Z_][a-zA-Z0-9_]*="([^"\\\n]|\\[\\"n])*")*\})? (-?[0-9.]+(e[+-]?[0-9]+)?|NaN|[+-]Inf))re");
  EXPECT_TRUE(text.ends_with('\n'));
  std::map<std::string, double> samples;
  std::set<std::string> typed, helped;
  std::istringstream lines(text);
  std::string current;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, help)) {
      EXPECT_TRUE(helped.insert(match[1]).second) << line;
    } else if (std::regex_match(line, match, type)) {
      current = match[1];
      EXPECT_TRUE(helped.contains(current)) << line;
      EXPECT_TRUE(typed.insert(current).second) << line;
      EXPECT_EQ(current.ends_with("_total"), match[2] == "counter") << line;
    } else if (std::regex_match(line, match, sample)) {
      EXPECT_EQ(match[1], current) << "the samples of a name stand together: " << line;
      EXPECT_TRUE(samples.emplace(match[1].str() + match[2].str(), std::stod(match[6])).second)
          << line;
    } else {
      ADD_FAILURE() << "no line of the format: " << line;
    }
  }
  return samples;
}

}  // namespace

TEST(Metrics, TheTextKeepsTheFormatsGrammar) {
  Counts counts;
  counts.uptime = 1e300;
  counts.workers = {{"cpu views", 3, 1}};
  counts.jobs.rays[v1::GL] = ~std::uint64_t{0};
  counts.jobs.worker_seconds[v1::CPU] = 0.1;
  const std::string text = prometheus_text(counts);
  const auto samples = samples_of(text);
  EXPECT_EQ(samples.at("metamer_uptime_seconds"), 1e300);
  EXPECT_EQ(samples.at("metamer_rays_total{backend=\"gl\"}"), 18446744073709551615.0);
  EXPECT_EQ(samples.at("metamer_worker_seconds_total{backend=\"cpu\"}"), 0.1);
  EXPECT_EQ(samples.at("metamer_refusals_total{code=\"CLOSING\"}"), 0.0);
  EXPECT_EQ(samples.at("metamer_worker_losses_total{worker=\"cpu views\"}"), 1.0);
  for (const MetricRow& row : all_metrics()) {
    EXPECT_NE(text.find(std::string("# TYPE ") + row.name + " "), std::string::npos) << row.name;
    EXPECT_TRUE(std::string(row.name).starts_with("metamer_")) << row.name;
    EXPECT_FALSE(row.samples(counts).empty()) << row.name;
  }
  if (std::system("command -v promtool > /dev/null") != 0) return;
  const TemporaryFolder folder = TemporaryFolder::make().value();
  std::ofstream(folder.path() / "m.prom") << text;
  EXPECT_EQ(
      std::system(("promtool check metrics < " + (folder.path() / "m.prom").string()).c_str()), 0);
}

TEST(Metrics, WhatHappensIsCounted) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto job = client.submit("picture 64 48 16");
  client.watch(job);
  client.receive_event_until([](auto& event) { return event.has_finished(); });
  client.watch(client.submit("fail"));
  v1::Envelope stranger;
  stranger.mutable_watch()->set_job_id(4711);
  EXPECT_EQ(client.ask(stranger).error().code(), v1::Error::NOT_FOUND);

  std::map<std::string, double> counted;
  const v1::Info info = client.info();
  for (const v1::Metric& metric : info.metric())
    counted[metric.name() + (metric.label().empty() ? "" : "{" + metric.label() + "}")] =
        metric.value();
  EXPECT_EQ(counted.at("metamer_jobs_submitted_total"), 2);
  EXPECT_EQ(counted.at("metamer_jobs_ended_total{end=\"finished\"}"), 1);
  EXPECT_EQ(counted.at("metamer_tiles_total{backend=\"cpu\"}"), 12);
  EXPECT_EQ(counted.at("metamer_refusals_total{code=\"NOT_FOUND\"}"), 1);
  EXPECT_EQ(counted.at("metamer_sessions"), 1);
  EXPECT_EQ(counted.at("metamer_sessions_total"), 1);
  EXPECT_GT(counted.at("metamer_sent_bytes_total"), 64 * 48 * 12);
  EXPECT_GT(counted.at("metamer_received_bytes_total"), 0);
  EXPECT_GT(counted.at("metamer_store_bytes"), 0);
}

TEST(Usage, AnAdminIsToldOfAllAndOthersOfThemselves) {
  Daemon daemon([](ServiceOptions& options) { options.limits.user_work = 3600; });
  Client admin(daemon.socket());
  Client other(daemon.port());
  for (Client* client : {&admin, &other}) {
    client->hello();
    client->watch(client->submit("picture 64 48 16"));
    client->receive_event_until([](auto& event) { return event.has_finished(); });
  }
  const v1::Info all = admin.info();
  EXPECT_EQ(all.user_size(), 2);
  ASSERT_EQ(all.session_size(), 2);
  EXPECT_EQ(all.session(0).client(), "test");
  EXPECT_NE(all.session(0).user(), all.session(1).user());
  EXPECT_GE(all.session(0).age(), all.session(0).idle());

  const v1::Info own = other.info();
  EXPECT_EQ(own.session_size() + own.metric_size(), 0);
  ASSERT_EQ(own.user_size(), 1);
  EXPECT_EQ(own.user(0).role(), v1::SUBMITTER);
  EXPECT_EQ(own.user(0).sessions(), 1u);
  EXPECT_EQ(own.user(0).jobs_ended(), 1u);
  EXPECT_EQ(own.user(0).picture_bytes(), 64u * 48 * 12);
  EXPECT_GT(own.user(0).worker_seconds(), 0);
  EXPECT_EQ(own.user(0).share(), 1);
  EXPECT_EQ(own.user(0).day_seconds(), own.user(0).worker_seconds());
  for (const v1::UserUsage& user : all.user()) {
    EXPECT_EQ(user.day_seconds(), user.worker_seconds());
    EXPECT_EQ(user.max_day_seconds(), user.role() == v1::ADMIN ? 0 : 3600);
  }
}

TEST(Metrics, TheFileIsThereWholeFromTheStart) {
  const TemporaryFolder folder = TemporaryFolder::make().value();
  const auto file = folder.path() / "m.prom";
  Program program(folder.path(), {"--listen", "unix:" + (folder.path() / "socket").string(),
                                  "--parent-fd", "3", "--metrics-file", file.string()});
  ASSERT_EQ(program.ready(), "ready\n");
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(samples_of(text).at("metamer_jobs_queued"), 0);
}

TEST(Metrics, AFileIsReplacedByRenamingAndNothingIsLeftBesideIt) {
  const TemporaryFolder folder = TemporaryFolder::make().value();
  const auto file = folder.path() / "m.prom";
  ASSERT_TRUE(replace_file(file, "one\n"));
  struct stat first {
  }, second{};
  ASSERT_EQ(::stat(file.c_str(), &first), 0);
  std::ifstream reader(file);
  ASSERT_TRUE(replace_file(file, "two\n"));
  ASSERT_EQ(::stat(file.c_str(), &second), 0);
  EXPECT_NE(first.st_ino, second.st_ino);
  EXPECT_EQ(second.st_mode & 0777, 0644u);
  std::string line;
  std::getline(reader, line);
  EXPECT_EQ(line, "one");
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path()))
    ++files;
  EXPECT_EQ(files, 1u);
  const auto missing = replace_file(folder.path() / "no" / "m.prom", "x");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("No such file or directory"), std::string::npos);
}

}  // namespace metamer::service::test
