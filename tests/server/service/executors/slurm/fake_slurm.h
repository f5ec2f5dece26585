#pragma once

#include <filesystem>
#include <string>

namespace metamer::service::test {

/// sbatch, squeue and scancel in front of PATH, as scripts that run tasks on this machine at once.
/// What goes wrong is told by words, which are files in its folder:
///
///     down        none of them answers
///     refuse      sbatch says no
///     forget      sbatch says a number, and that is all that comes of it
///     hold        tasks wait until the word is taken back
///     nothing     tasks end without running anything
///     speechless  tasks fail without a result, and say why
class FakeSlurm {
 public:
  FakeSlurm();
  ~FakeSlurm();
  FakeSlurm(const FakeSlurm&) = delete;

  void say(const std::string& word) const;
  void take_back(const std::string& word) const;
  /// Tasks that were submitted so far, and names that were cancelled.
  std::size_t submitted() const;
  std::size_t cancelled() const;
  /// All words of the sbatch that came first.
  std::string first_words() const;
  /// What its tasks ran.
  std::string first_script() const;
  /// A task that nobody here has submitted is listed as running.
  void list_stranger(const std::string& name) const;
  bool was_cancelled(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  std::string path_before_;
};

}  // namespace metamer::service::test
