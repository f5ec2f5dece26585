#include "scene_text.h"

#include "common/scene/validate.h"

namespace metamer::test {

namespace {

SceneFile parsed(const std::string& text) {
  auto scene = SceneFile::parse(text, "s.txtpb");
  return std::move(scene).value();  // Throws, and so fails the test, where it is an error.
}

}  // namespace

std::string parse_error(const std::string& text) {
  const auto scene = SceneFile::parse(text, "s.txtpb");
  return scene ? std::string() : format(scene.error(), text);
}

std::vector<std::string> text_findings(const std::string& text) {
  return describe(validate_scene(parsed(text).scene()));
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
