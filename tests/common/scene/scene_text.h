#pragma once

#include <string>
#include <vector>

#include "common/problem.h"
#include "common/scene/scene_file.h"

/// Scenes as text, for tests.
namespace metamer::test {

/// The parts of a sound scene; a test replaces one of them.
struct SceneText {
  std::string camera = "camera { eye { z: 4 } }\n";
  std::string light = "light { position { y: 2 } spectrum { standard: \"D65\" } }\n";
  std::string material = "material { name: \"grey\" diffuse { constant: 0.5 } }\n";
  std::string object = "object { material: \"grey\" sphere { radius: 1 } }\n";
  std::string settings = "";

  std::string all() const { return camera + light + material + object + settings; }
};

/// A message that offers something names it, and put in its place it removes the problem:
/// `problem`, of `text`. text_findings and parse_error expect it of all that they find.
void expect_offer_mends(const std::string& text, Problem problem);

/// What parsing `text`, the file "s.txtpb", says, as a person sees it; empty: nothing.
std::string parse_error(const std::string& text);

/// What validate_scene finds in `text`, which must parse: "field: message" each.
std::vector<std::string> text_findings(const std::string& text);
std::vector<std::string> findings(const SceneText& scene);

/// "line:column" of a field path in `text`, which must parse; "nowhere" where there is none.
std::string place_of(const std::string& text, const std::string& field);

std::vector<std::string> describe(const std::vector<Problem>& problems);

using Strings = std::vector<std::string>;

}  // namespace metamer::test
