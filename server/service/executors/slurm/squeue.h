#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/problem.h"

namespace metamer::service {

/// A task as `squeue --json` lists it.
struct ListedTask {
  enum class State {
    waiting,
    running,
    ended,  ///< By itself or otherwise; Slurm forgets it after a while (MinJobAge).
  };
  std::string name;  ///< Of the job: ours.
  /// Its place in the job's array; nothing: all that are not listed by themselves.
  std::optional<std::uint32_t> index;
  State state = State::waiting;
  std::string word;  ///< Slurm's for it: "NODE_FAIL".
  std::string node;  ///< Empty while it waits.
};

/// The state that one of Slurm's words says; a word that nobody knows may be anything that runs.
ListedTask::State state_of(std::string_view word);

/// The tasks in what squeue says whose names begin with `prefix`, of Slurm 22.05 and later, whose
/// states and numbers are lists and objects. Whoever may submit has a say in it: names and words
/// are bounded and made printable, nothing but these is kept. Errors: no such document; more than
/// max_listed of them.
Result<std::vector<ListedTask>> read_squeue(std::string_view json, std::string_view prefix);

/// More tasks than we ever have at a time.
inline constexpr std::size_t max_listed = 100'000;

}  // namespace metamer::service
