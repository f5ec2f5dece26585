// TCP peers that are gone without FIN: the system asks whether they are there (tcp(7)).

#include <gtest/gtest.h>
#include <unistd.h>

#include "../client.h"
#include "../daemon.h"

namespace metamer::service::test {

TEST(HalfOpen, TheIdleAndTheUnreadGiveTheirPlacesBackAndOthersAreServed) {
  Daemon daemon([](ServiceOptions& options) {
    options.listening.dead_peer = std::chrono::seconds(1);
    // Nothing else ends them.
    options.patience.stall = options.patience.idle_session = std::chrono::hours(1);
  });
  Client owner(daemon.socket());
  owner.hello();
  Client fast(daemon.port());
  fast.hello();
  Client idle(daemon.port());
  idle.hello();
  Client fed(daemon.port());
  fed.hello();
  const auto job = fed.submit("gate 0");
  fed.watch(job);
  fed.receive_event_until([](auto& event) { return event.has_planned(); });
  ASSERT_EQ(owner.info().sessions(), 4u);

  idle.vanish();
  fed.vanish();
  daemon.open_gate();
  for (int tries = 0; tries < 1000 && owner.info().sessions() > 2; ++tries) {
    fast.ping();
    ::usleep(10'000);
  }
  EXPECT_EQ(owner.info().sessions(), 2u);
  fast.ping();
  // Its job goes on without it, and can be read by others of its user.
  fast.watch(job);
  fast.receive_event_until([](auto& event) { return event.has_finished(); });
}

}  // namespace metamer::service::test
