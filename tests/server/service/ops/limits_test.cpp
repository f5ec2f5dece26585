// Limits that an administrator sets: told to clients, and held.

#include "server/service/limits.h"

#include <gtest/gtest.h>

#include "../client.h"
#include "../daemon.h"
#include "common/digest.h"

namespace metamer::service::test {

namespace {

v1::Envelope ask_to_watch(std::uint64_t job) {
  v1::Envelope message;
  message.mutable_watch()->set_job_id(job);
  return message;
}

}  // namespace

TEST(Limits, ThoseThatAreSetAreToldAndHeld) {
  Daemon daemon([](ServiceOptions& options) {
    options.limits.session_watches = 1;
    options.limits.live_jobs = 2;
    options.limits.session_views = 1;
    options.limits.held_assets = 2;
  });
  Client client(daemon.socket());
  const v1::Limits told = client.hello().limits();
  EXPECT_EQ(told.watches(), 1u);
  EXPECT_EQ(told.queued_jobs(), 2u);
  EXPECT_EQ(told.views(), 1u);
  const auto job = client.submit("stall 3");
  client.watch(job, 0, false);
  EXPECT_EQ(client.ask(ask_to_watch(job)).error().message(), "a client may watch 1 jobs at a time");

  v1::Envelope submit;
  submit.mutable_submit()->set_scene_sha256(client.upload({"stall 3"})[0]);
  for (int more = 0; more < 2 && !client.ask(submit).has_error(); ++more) {
  }
  EXPECT_EQ(client.ask(submit).error().code(), v1::Error::LIMIT);

  client.upload({"another"});
  v1::Envelope offer;
  offer.mutable_offer_assets()->add_sha256(std::string(to_bytes(sha256("a third"))));
  EXPECT_EQ(client.ask(offer).error().message(), "a client may hold 2 assets");
}

}  // namespace metamer::service::test
