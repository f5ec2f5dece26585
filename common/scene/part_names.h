#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "common/scene/findings.h"

namespace metamer {

/// The names of one kind of thing in a scene, and which of them had each first.
class PartNames {
 public:
  explicit PartNames(std::string kind) : kind_(std::move(kind)) {}

  /// Takes the name of number `index`; an empty one names nothing. Finds names that are too long or
  /// taken already.
  void take(const std::string& name, std::size_t index, Findings& findings);

  bool contains(const std::string& name) const { return first_.contains(name); }

  /// Finds that `name`, which stands at `field`, is none of these.
  void check_known(const std::string& name, const std::string& field, Findings& findings);

 private:
  Problem unknown(const std::string& name);

  std::string kind_;
  std::map<std::string, std::size_t> first_;
  std::vector<std::string> names_;
  std::map<std::string, Problem> unknown_;
};

/// The number of parts to check: all of them, or as many as a scene may hold, which is a finding.
std::size_t check_count(int count, std::size_t most, const std::string& kind, Findings& findings);

}  // namespace metamer
