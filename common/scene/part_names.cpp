#include "common/scene/part_names.h"

#include "common/scene/limits.h"

namespace metamer {

void PartNames::take(const std::string& name, std::size_t index, Findings& findings) {
  if (name.empty()) return;
  const std::string field = indexed(kind_, index) + ".name";
  if (name.size() > limits::max_name) {
    findings.add(field, "name is too long (" + std::to_string(name.size()) + " bytes; at most " +
                            std::to_string(limits::max_name) + ")");
  }
  const auto [first, is_new] = first_.try_emplace(name, index);
  if (is_new) {
    names_.push_back(name);
  } else {
    findings.add(field, kind_ + " " + quoted(name) + " is defined twice (first as " +
                            indexed(kind_, first->second) + ")");
  }
}

void PartNames::check_known(const std::string& name, const std::string& field, Findings& findings) {
  if (!contains(name)) findings.add(field, unknown(name));
}

/// That an unknown name is not defined. A guess costs a comparison with every name, so only the
/// first few unknown names get one, and no name that is too long to be shown whole.
Problem PartNames::unknown(const std::string& name) {
  constexpr std::size_t max_guesses = 10, max_length = 60;
  if (const auto known = unknown_.find(name); known != unknown_.end()) return known->second;
  const std::string message = kind_ + " " + quoted(name) + " is not defined";
  if (unknown_.size() == max_guesses || name.size() > max_length)
    return {.field = {}, .file = {}, .message = message};
  return unknown_[name] = unknown_name(message, name, names_);
}

std::size_t check_count(int count, std::size_t most, const std::string& kind, Findings& findings) {
  const auto size = static_cast<std::size_t>(count);
  if (size <= most) return size;
  findings.add(indexed(kind, most), "a scene may have at most " + std::to_string(most) + " " +
                                        kind + "s (it has " + std::to_string(size) + ")");
  return most;
}

}  // namespace metamer
