// Series: what a client says of its jobs is held to bounds, and given back.
#include <gtest/gtest.h>

#include "../daemon.h"
#include "../temporary_state.h"
#include "server/service/limits.h"

namespace metamer::service::test {
namespace {

v1::Envelope part_of_series(const std::string& scene, std::uint32_t index) {
  v1::Envelope message;
  v1::Submit& submit = *message.mutable_submit();
  submit.set_scene_sha256(scene);
  v1::Series& series = *submit.mutable_series();
  series.set_id(std::string(series_id_bytes, '\xAB'));
  series.set_name(std::string(max_series_text, 'n'));
  series.set_label("frame " + std::to_string(index));
  series.set_index(index);
  series.set_count(max_series_jobs);
  return message;
}

TEST(Series, BeyondTheBoundsIsRefused) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const std::string scene = client.upload({"picture 8 8 8"}).front();
  const std::vector<std::pair<std::function<void(v1::Series&)>, std::string>> wrong = {
      {[](v1::Series& s) { s.clear_id(); }, "a series' id has 16 bytes, not 0"},
      {[](v1::Series& s) { s.set_id(std::string(17, 'x')); }, "a series' id has 16 bytes, not 17"},
      {[](v1::Series& s) { *s.mutable_name() += 'n'; },
       "a series' name of 257 bytes is over the limit of 256"},
      {[](v1::Series& s) { s.set_label(std::string(257, 'l')); },
       "the label of a series' job of 257 bytes is over the limit of 256"},
      {[](v1::Series& s) { s.set_count(100'001); },
       "a series of 100001 jobs is over the limit of 100000"},
      {[](v1::Series& s) { s.set_index(s.count()); },
       "a series of 100000 has no job of index 100000"},
      {[](v1::Series& s) { s.set_count(0); }, "a series of 0 has no job of index 3"}};
  for (const auto& [break_it, message] : wrong) {
    v1::Envelope submit = part_of_series(scene, 3);
    break_it(*submit.mutable_submit()->mutable_series());
    const v1::Envelope answer = client.ask(submit);
    EXPECT_EQ(answer.error().code(), v1::Error::LIMIT);
    EXPECT_EQ(answer.error().message(), message);
  }
  EXPECT_TRUE(client.ask(part_of_series(scene, 0)).has_submitted());
  EXPECT_TRUE(client.ask(part_of_series(scene, max_series_jobs - 1)).has_submitted());
}

TEST(Series, IsGivenBackAlsoAfterARestart) {
  const TemporaryState state;
  std::uint64_t job = 0;
  v1::Series sent;
  for (const bool again : {false, true}) {
    Daemon daemon([&](ServiceOptions& options) {
      options.state = state.path();
      options.store.clear();
    });
    Client client(daemon.socket());
    client.hello();
    if (!again) {
      const v1::Envelope submit = part_of_series(client.upload({"picture 8 8 8"}).front(), 12);
      sent = submit.submit().series();
      job = client.ask(submit).submitted().job_id();
    }
    EXPECT_EQ(client.summary(job).series().SerializeAsString(), sent.SerializeAsString());
  }
}

}  // namespace
}  // namespace metamer::service::test
