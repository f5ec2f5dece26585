#include "client/cli/scene_input.h"

#include "client/cli/overrides.h"

namespace metamer::cli {

std::optional<CheckedScene> load_scene(const std::string& file, const Overrides& overrides,
                                       Report& report) {
  DigestCache digests;
  CheckedScene scene = CheckedScene::read(
      file, digests, [&](v1::Scene& parsed) { return apply(overrides, parsed); });
  if (scene.sound()) return scene;
  for (const Problem& one : scene.problems()) report.described_problem(one, scene.describe(one));
  return std::nullopt;
}

void report_problems(const CheckedScene& scene, const std::vector<Problem>& problems,
                     Report& report) {
  for (const Problem& one : scene.locate(problems))
    report.described_problem(one, scene.describe(one));
}

void report_notice(const CheckedScene& scene, const v1::Notice& notice, Report& report) {
  Problem note;
  note.field = notice.field();
  note.message = notice.message();
  report.note(scene.locate(std::move(note)));
}

}  // namespace metamer::cli
