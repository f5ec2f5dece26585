// The window's thread waits neither for the network nor for a file: all pages, against a server
// that takes a second for each answer.
#include "stall_watch.h"

#include "client/gui/app/tour.h"
#include "tests/client/gui/link/faulty_window.h"
#include "tests/client/gui/link/relay.h"

namespace metamer::gui {
namespace {

constexpr std::chrono::seconds answer_takes(1);
/// ms. A wait for one answer would be twice as long; one for another thread that a busy machine has
/// halted is shorter.
constexpr double longest_sleep = 1000.0 * answer_takes.count() / 2;

class Stall : public FaultyWindow {};

TEST_F(Stall, NoPageWaitsForAServerThatTakesASecondForEachAnswer) {
  Relay relay;
  relay.delay = answer_takes;
  link_.open(QString::fromStdString(relay.address()));
  double longest = 0;
  const auto watch = [&](const char* name, const std::function<void()>& act) {
    StallWatch stalls;
    act();
    std::printf("%-12s %5.0f ms at most between two events, of them %3.0f ms asleep\n", name,
                stalls.longest(), stalls.slept());
    EXPECT_LT(stalls.slept(), longest_sleep) << name;
    longest = std::max(longest, stalls.longest());
  };
  watch("connecting", [&] { EXPECT_TRUE(wait([&] { return live().frame() != nullptr; })); });
  for (const TourStep& step : tour_steps())
    watch(step.name, [&] {
      // A modal dialog runs a loop of its own.
      QTimer::singleShot(120, &window_, [&] {
        if (QWidget& shown = front_window(window_); &shown != &window_) shown.close();
      });
      take_step(window_, step);
      QTest::qWait(250);
    });
  // What came meanwhile is shown.
  watch("the rest", [&] { QTest::qWait(1500); });
  std::printf("in all       %5.0f ms at most between two events\n", longest);
}

}  // namespace
}  // namespace metamer::gui
