// The table of promise against outcome, and what choosing costs beside having known the best
// method: one Markdown page on stdout. Run by deploy/report.

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "tests/promises/measured_scene.h"

namespace metamer::promises {
namespace {

std::string name_of(const v1::Method& method) {
  std::string text = method.ShortDebugString();
  std::replace(text.begin(), text.end(), '|', ' ');
  return text;
}

struct Outcome {
  v1::Method method;
  MeasuredScene::Rendered rendered;
};

/// The quicker of two renderings of each candidate.
std::vector<Outcome> render_all(MeasuredScene& scene) {
  std::vector<Outcome> all;
  for (const v1::Method& method : candidates()) {
    Outcome outcome{method, scene.render(method)};
    outcome.rendered.seconds = std::min(outcome.rendered.seconds, scene.render(method).seconds);
    all.push_back(std::move(outcome));
  }
  return all;
}

/// Prints a line for each tolerance; returns the sums of the times with the choice and with the
/// best.
std::pair<double, double> report(const VariedScene& varied) {
  MeasuredScene scene(varied);
  const std::vector<Outcome> all = render_all(scene);
  std::pair<double, double> times{0, 0};
  for (const double promise : {0.1, 0.5, 1.0, 2.0}) {
    const auto start = std::chrono::steady_clock::now();
    const PilotScene pilot = scene.pilot();
    const Choice choice = choose(pilot, tolerance(promise), 0);
    const double choosing =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const v1::ColorError measured = measure(pilot, *choice.prepared);
    const MeasuredScene::Rendered rendered = scene.render(choice.method);

    const Outcome* best = nullptr;
    for (const Outcome& one : all)
      if (one.rendered.error.maximum() <= promise &&
          (!best || one.rendered.seconds < best->rendered.seconds))
        best = &one;
    const double known = best ? best->rendered.seconds : rendered.seconds;
    times.first += choosing + rendered.seconds;
    times.second += known;
    std::printf("| %s | %g | %s | %.3f | %.3f | %.3f | %s | %s | %.3f | %.3f |\n",
                varied.about.c_str(), promise, name_of(choice.method).c_str(), measured.mean(),
                measured.maximum(), rendered.error.maximum(),
                rendered.error.maximum() <= promise ? "kept" : "**broken**",
                best ? name_of(best->method).c_str() : "none", choosing / known,
                (choosing + rendered.seconds) / known);
  }
  std::fflush(stdout);
  return times;
}

int run(std::uint32_t scenes, std::uint32_t side) {
  std::puts("# Promise against outcome\n");
  std::puts(
      "`--method auto --tolerance T` on scenes that the choice was not tuned on (tests/promises). "
      "ΔE00 "
      "against the 1 nm reference; \"fresh\": on pixels that had no part in the choice; \"all\": "
      "on every "
      "pixel. Best: the quickest method whose every pixel keeps the promise. The last two columns "
      "are "
      "ratios of times of one run on one thread: choosing by best, and choosing and rendering by "
      "best.\n");
  std::puts(
      "| scene | promise | chosen | fresh mean | fresh max | all max | outcome | best | choosing | "
      "in "
      "all |\n|---|---|---|---|---|---|---|---|---|---|");
  double chosen = 0, known = 0;
  for (const VariedScene& varied : varied_scenes(scenes, side)) {
    const auto [with_choice, with_best] = report(varied);
    chosen += with_choice;
    known += with_best;
  }
  std::printf(
      "\nAll together, choosing and rendering took %.3f times what the best methods take.\n",
      chosen / known);
  return 0;
}

}  // namespace
}  // namespace metamer::promises

/// promise_report [SCENES [SIDE]]: so many scenes, so many pixels wide.
int main(int count, char** words) {
  const auto number = [&](int at, std::uint32_t otherwise) {
    return count > at ? static_cast<std::uint32_t>(std::atoi(words[at])) : otherwise;
  };
  return metamer::promises::run(number(1, 24), number(2, 640));
}
