#pragma once

#include <string>
#include <vector>

#include "common/scene/findings.h"
#include "metamer/v1/plan.pb.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

/// One of candidates(), in protobuf text format. Those of a lower turn come first.
struct Trial {
  int turn;
  const char* method;
};

/// A way to carry colour as both sides know it: all but its arithmetic, which is in server/methods.
/// A function that is null has nothing to do; without a text, the word says it all.
struct MethodEntry {
  const char* word;  ///< Its member of v1::Method.method, and its name on the command line.
  std::vector<Trial> trials;
  std::vector<std::string> compared = {};  ///< In text format; empty: itself, by its defaults.
  void (*fill)(v1::Method&) = nullptr;     ///< Fills in what was left out.
  /// Says what is wrong with one whose defaults are filled in. `field` is the member's path.
  void (*check)(const v1::Method&, const std::string& field, Findings&) = nullptr;
  std::string (*text)(const v1::Method&) = nullptr;   ///< "linear 4 observer".
  std::string (*planned)(const v1::Plan&) = nullptr;  ///< "linear with 4 basis functions …".
};

/// Every method, in the order in which people read them.
const std::vector<MethodEntry>& method_entries();

/// Of the method that is set; null where none is.
const MethodEntry* method_entry(const v1::Method& method);

/// "point, linear, exact, prefilter, rgb".
std::string method_words();

/// A method with its parameters as people write it: "point 400:700:5", "linear 4 observer",
/// "exact"; empty where none is set. Its defaults must be filled in.
std::string method_text(const v1::Method& method);

/// The method of a plan and what the scene made of it: "exact with 7 signatures".
std::string planned_method_text(const v1::Plan& plan);

/// Every method with the parameters that are worth their price: the exact one first, as it is
/// mostly among the cheapest too, then the cheapest first as far as that can be told beforehand.
/// What they cost in a scene is measured.
std::vector<v1::Method> candidates();

/// A method by its defaults.
v1::Method default_method(const MethodEntry& entry);

/// Every method over its parameters, for those who want to compare them; the naive rgb comes first.
std::vector<v1::Method> compared_methods();

}  // namespace metamer
