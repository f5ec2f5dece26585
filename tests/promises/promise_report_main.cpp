// The table of promise against outcome, and what choosing costs beside having known the best
// method: one Markdown page on stdout. Run by deploy/report.

#include <google/protobuf/util/message_differencer.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "tests/promises/measured_scene.h"

namespace metamer::promises {
namespace {

using google::protobuf::util::MessageDifferencer;

std::string name_of(const v1::Method& method) {
  std::string text = method.ShortDebugString();
  std::replace(text.begin(), text.end(), '|', ' ');
  return text;
}

struct Outcome {
  v1::Method method;
  MeasuredScene::Rendered rendered;
};

std::vector<Outcome> render_all(MeasuredScene& scene) {
  std::vector<Outcome> all;
  for (const v1::Method& method : candidates()) all.push_back({method, scene.render(method)});
  return all;
}

/// The quickest of those whose every pixel keeps the promise.
const Outcome* best_of(const std::vector<Outcome>& all, double promise) {
  const Outcome* best = nullptr;
  for (const Outcome& one : all)
    if (one.rendered.error.maximum() <= promise &&
        (!best || one.rendered.seconds < best->rendered.seconds))
      best = &one;
  return best;
}

/// What is chosen is one of the candidates, with numbers that the plan fills in.
v1::ColorError error_of(const std::vector<Outcome>& all, MeasuredScene& scene,
                        const v1::Method& method) {
  for (const Outcome& one : all)
    if (MessageDifferencer::Equals(plan_with(scene.pilot(), one.method).method(),
                                   plan_with(scene.pilot(), method).method()))
      return one.rendered.error;
  return scene.render(method).error;
}

/// Seconds, each the less of two that take turns.
struct Times {
  double choosing = std::numeric_limits<double>::infinity(), chosen = choosing, best = choosing;
};

Times time_all(MeasuredScene& scene, const v1::Goal& goal, const v1::Method& chosen,
               const v1::Method& best) {
  Times times;
  for (int turn = 0; turn < 2; ++turn) {
    const auto start = std::chrono::steady_clock::now();
    choose(scene.pilot(), goal, 0);
    const std::chrono::duration<double> choosing = std::chrono::steady_clock::now() - start;
    times.choosing = std::min(times.choosing, choosing.count());
    times.chosen = std::min(times.chosen, scene.render(chosen).seconds);
    times.best = std::min(times.best, scene.render(best).seconds);
  }
  return times;
}

/// What many promises came to.
struct Tally {
  Times times{0, 0, 0};
  int promises = 0, broken = 0;
};

/// Prints a line for each tolerance.
void report(const VariedScene& varied, Tally& tally) {
  MeasuredScene scene(varied);
  const std::vector<Outcome> all = render_all(scene);
  for (const double promise : {0.1, 0.5, 1.0, 2.0}) {
    const PilotScene pilot = scene.pilot();
    const Choice choice = choose(pilot, tolerance(promise), 0);
    const v1::ColorError measured = measure(pilot, *choice.prepared).error();
    const v1::ColorError error = error_of(all, scene, choice.method);
    const Outcome* best = best_of(all, promise);
    const Times times =
        time_all(scene, tolerance(promise), choice.method, best ? best->method : choice.method);
    tally.times.choosing += times.choosing;
    tally.times.chosen += times.chosen;
    tally.times.best += times.best;
    ++tally.promises;
    tally.broken += error.maximum() > promise;
    std::printf("| %s | %g | %s | %.3f | %.3f | %.3f | %s | %s | %.3f | %.3f |\n",
                varied.about.c_str(), promise, name_of(choice.method).c_str(), measured.mean(),
                measured.maximum(), error.maximum(),
                error.maximum() <= promise ? "kept" : "**broken**",
                best ? name_of(best->method).c_str() : "none", times.choosing / times.best,
                (times.choosing + times.chosen) / times.best);
  }
  std::fflush(stdout);
}

int run(std::uint32_t scenes, std::uint32_t side, std::uint32_t spp) {
  std::puts("# Promise against outcome\n");
  std::printf(
      "`--method auto --tolerance T` on scenes that the choice was not tuned on (tests/promises), "
      "%u pixels wide with %u samples each. ΔE00; \"drawn\": against the reference, on "
      "pixels drawn at random; \"all\": on every pixel, against plain sums over 0.005 nm. Best: "
      "the quickest method whose "
      "every pixel keeps the promise. The last two columns are ratios of times of one run on one "
      "thread: choosing by best, and choosing and rendering by best.\n\n",
      side, spp);
  std::puts(
      "| scene | promise | chosen | drawn mean | drawn max | all max | outcome | best | choosing | "
      "in all |\n|---|---|---|---|---|---|---|---|---|---|");
  Tally tally;
  for (const auto& draw : {varied_scenes, narrow_scenes})
    for (const VariedScene& varied : draw(scenes, side, spp)) report(varied, tally);
  std::printf("\n%d of %d promises were kept.", tally.promises - tally.broken, tally.promises);
  std::printf(
      " All together, choosing took %.3f times what the best methods take, and choosing "
      "and rendering %.3f times.\n",
      tally.times.choosing / tally.times.best,
      (tally.times.choosing + tally.times.chosen) / tally.times.best);
  return tally.broken == 0 ? 0 : 1;
}

}  // namespace
}  // namespace metamer::promises

/// promise_report [SCENES [SIDE [SPP]]]: so many scenes of smooth lights and as many of narrow
/// lines, so many pixels wide, samples each. Ends with 1 where a promise was broken.
int main(int count, char** words) {
  const auto number = [&](int at, std::uint32_t otherwise) {
    return count > at ? static_cast<std::uint32_t>(std::atoi(words[at])) : otherwise;
  };
  return metamer::promises::run(number(1, 20), number(2, 640), number(3, 16));
}
