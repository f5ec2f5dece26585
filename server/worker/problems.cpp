#include "server/worker/problems.h"

#include <algorithm>

#include "common/scene/findings.h"
#include "server/worker/assets.h"

namespace metamer::worker {
namespace {

/// The beginning of a text that may have come from a file's bytes.
std::string shown(const std::string& text, std::size_t most) {
  std::string cut = text.substr(0, most);
  while (!cut.empty() && cut.size() < text.size() && (text[cut.size()] & 0xC0) == 0x80)
    cut.pop_back();  // Not in the middle of a character.
  if (!is_utf8(cut))
    std::replace_if(
        cut.begin(), cut.end(), [](char c) { return (c & 0x80) != 0; }, '?');
  return cut;
}

}  // namespace

void set_problem(const Problem& problem, v1::Problem& to) {
  to.set_field(shown(problem.field, 500));
  to.set_file(shown(problem.file, 500));
  to.set_line(static_cast<std::uint32_t>(problem.line));
  to.set_column(static_cast<std::uint32_t>(problem.column));
  to.set_message(shown(problem.message, 1000));
  // Whole or not at all: one is put in the other's place.
  constexpr std::size_t most = 500;
  const auto fits = [&](const std::string& text) { return text.size() <= most && is_utf8(text); };
  if (!fits(problem.was) || !fits(problem.meant)) return;
  to.set_was(problem.was);
  to.set_meant(problem.meant);
}

void add_problems(const std::vector<Problem>& problems,
                  google::protobuf::RepeatedPtrField<v1::Problem>& to) {
  // A hostile scene can have more problems than a frame holds; nobody reads the 101st.
  for (std::size_t i = 0; i < problems.size() && i < 100; ++i) set_problem(problems[i], *to.Add());
}

v1::Failed failed_for(v1::Failed::Kind kind, const std::string& reason) {
  v1::Failed failed;
  failed.set_kind(kind);
  failed.set_reason(reason);
  return failed;
}

v1::Failed failed_for(const std::vector<Problem>& problems) {
  const std::size_t count = problems.size();
  const bool has_place = count > 1 || !problems[0].field.empty() || !problems[0].file.empty();
  const auto damaged = std::find_if(problems.begin(), problems.end(), is_damage);
  v1::Failed failed;
  if (damaged != problems.end())
    failed = failed_for(v1::Failed::SERVER,
                        "the server's file of " +
                            (damaged->file.empty() ? "the scene" : shown(damaged->file, 500)) +
                            " is damaged; send it again");
  else if (has_place)
    failed = failed_for(v1::Failed::BAD_INPUT, "the scene has " + std::to_string(count) +
                                                   (count == 1 ? " problem" : " problems"));
  else
    failed = failed_for(v1::Failed::BAD_INPUT, shown(problems[0].message, 1000));
  if (has_place) add_problems(problems, *failed.mutable_problem());
  return failed;
}

}  // namespace metamer::worker
