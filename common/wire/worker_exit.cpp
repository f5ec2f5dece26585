#include "common/wire/worker_exit.h"

#include <signal.h>
#include <sys/wait.h>

#include <cstring>

namespace metamer::wire {

std::string describe_exit(int wait_status) {
  if (WIFSIGNALED(wait_status)) {
    const int signal = WTERMSIG(wait_status);
    const char* name = sigdescr_np(signal);
    return "killed by signal " + std::to_string(signal) + " (" + (name ? name : "unknown") + ")";
  }
  if (is_out_of_memory(wait_status)) return "ran out of memory";
  return "exited with code " + std::to_string(WEXITSTATUS(wait_status));
}

bool is_out_of_memory(int wait_status, bool kernel) {
  if (WIFSIGNALED(wait_status)) return kernel && WTERMSIG(wait_status) == SIGKILL;
  return WEXITSTATUS(wait_status) == exit_out_of_memory;
}

}  // namespace metamer::wire
