#include "scene_text.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/scene/validate.h"

namespace metamer::test {

namespace {

SceneFile parsed(const std::string& text) {
  auto scene = SceneFile::parse(text, "s.txtpb");
  return std::move(scene).value();  // Throws, and so fails the test, where it is an error.
}

}  // namespace

void expect_offer_mends(const std::string& text, Problem problem) {
  const std::string message = problem.message;
  if (message.find("did you mean") != std::string::npos) {
    EXPECT_FALSE(problem.meant.empty()) << message;
  }
  if (problem.meant.empty()) return;

  // Put it in the place of the first that is written so, from the problem's place on.
  std::size_t at = 0;
  for (int line = 1; line < problem.line; ++line) at = text.find('\n', at) + 1;
  at = text.find(problem.was, at + static_cast<std::size_t>(std::max(problem.column, 1)) - 1);
  ASSERT_NE(at, std::string::npos) << message << ": " << problem.was;
  std::string mended = text;
  mended.replace(at, problem.was.size(), problem.meant);

  const auto scene = SceneFile::parse(mended, "s.txtpb");
  if (!scene) {
    EXPECT_NE(scene.error().message, message);
    return;
  }
  for (const Problem& left : validate_scene(scene->scene())) {
    EXPECT_FALSE(left.field == problem.field && left.message == message) << message;
  }
}

std::string parse_error(const std::string& text) {
  const auto scene = SceneFile::parse(text, "s.txtpb");
  if (scene) return {};
  expect_offer_mends(text, scene.error());
  return format(scene.error(), text);
}

std::vector<std::string> text_findings(const std::string& text) {
  const SceneFile scene = parsed(text);
  const std::vector<Problem> problems = validate_scene(scene.scene());
  for (const Problem& problem : problems) expect_offer_mends(text, scene.locate(problem));
  return describe(problems);
}

std::vector<std::string> findings(const SceneText& scene) { return text_findings(scene.all()); }

std::string place_of(const std::string& text, const std::string& field) {
  const Problem problem = parsed(text).locate({.field = field, .file = {}, .message = {}});
  if (problem.line == 0) return "nowhere";
  return std::to_string(problem.line) + ":" + std::to_string(problem.column);
}

std::vector<std::string> describe(const std::vector<Problem>& problems) {
  std::vector<std::string> texts;
  for (const Problem& problem : problems) texts.push_back(problem.field + ": " + problem.message);
  return texts;
}

}  // namespace metamer::test
