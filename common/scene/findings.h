#pragma once

#include <google/protobuf/message.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/problem.h"

namespace metamer {

/// Collects what is wrong with a scene. Each finding has a field path and one sentence.
class Findings {
 public:
  void add(std::string field, std::string message);
  void add(Problem problem) { problems_.push_back(std::move(problem)); }
  void add(std::string field, Problem problem);
  /// A number that `nearest` can take the place of.
  void add(std::string field, std::string message, double value, double nearest);

  std::size_t size() const { return problems_.size(); }
  std::vector<Problem> take() { return std::move(problems_); }

 private:
  std::vector<Problem> problems_;
};

/// "light[3]".
std::string indexed(std::string_view field, std::size_t index);

/// Adds a finding when `value` is outside `low`..`high`; the field's last part is its name.
void check_range(double value, double low, double high, const std::string& field,
                 Findings& findings);

/// True when `text` is well-formed UTF-8 (RFC 3629).
bool is_utf8(std::string_view text);

/// Names what a newer client has put into the message itself and this version would silently leave
/// out.
void check_fields_known(const google::protobuf::Message& message, const std::string& field,
                        Findings& findings);

/// What must hold of every value of a message, whatever it means, found by reflection so that a new
/// field needs no line here: numbers finite and within limits::max_coordinate, text UTF-8 without
/// control characters and not over limits::max_text, enum values known, no field that this version
/// does not know. Returns true when all of it holds.
bool check_values(const google::protobuf::Message& message, const std::string& field,
                  Findings& findings);

}  // namespace metamer
