#include "server/service/executors/slurm/commands.h"

#include <chrono>

namespace metamer::service {
namespace {

/// For a shell.
std::string shell_quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace

std::string batch_script(const SlurmCommands::Options& options,
                         const std::filesystem::path& folder) {
  return "#!/bin/sh\nexec " + shell_quoted(options.worker.string()) + " --batch " +
         shell_quoted(folder.string() + "/") + "\"$SLURM_ARRAY_TASK_ID\".order --threads " +
         std::to_string(options.threads) +
         (options.gl_device.empty() ? "" : " --gl-device " + options.gl_device) +
         (options.unconfined ? " --unconfined yes\n" : "\n");
}

Result<void> SlurmCommands::submit(const Submission& submission) const {
  std::vector<std::string> words = {
      "sbatch",
      "--parsable",
      "--no-requeue",  // what is lost is handed out again by us, once and under another name
      "--job-name=" + submission.name,
      "--array=0-" + std::to_string(submission.count - 1),
      "--ntasks=1",
      "--cpus-per-task=" + std::to_string(options_.threads),
      "--nice=" + std::to_string(submission.nice),
      "--chdir=" + submission.folder.string(),
      "--output=" + (submission.folder / "%a.log").string()};
  if (!options_.gres.empty()) words.push_back("--gres=" + options_.gres);
  words.insert(words.end(), options_.arguments.begin(), options_.arguments.end());
  const auto said = run_command(words, batch_script(options_, submission.folder), {}, cancelled_);
  if (!said) return tl::unexpected(said.error());
  if (said->empty() || (*said)[0] < '0' || (*said)[0] > '9')
    return problem("sbatch gave no number of a job");
  return {};
}

Result<std::vector<ListedTask>> SlurmCommands::list(std::string_view prefix) const {
  // Until Slurm 23 it lists everybody's, whoever is asked for: 4 KiB each.
  const auto said =
      run_command({"squeue", "--json", "--me"}, {}, {.bytes = 256u << 20}, cancelled_);
  if (!said) return tl::unexpected(said.error());
  return read_squeue(*said, prefix);
}

Result<void> SlurmCommands::cancel(const std::vector<std::string>& names) const {
  static const std::atomic<bool> never = false;
  for (const std::string& name : names)  // scancel takes one at a time
    if (const auto said = run_command({"scancel", "--quiet", "--name=" + name}, {},
                                      {.time = std::chrono::seconds(5)}, never);
        !said)
      return tl::unexpected(said.error());  // the others would be waited for in vain
  return {};
}

}  // namespace metamer::service
