// cluster_bench [TURNS [SECONDS]]: what a picture of so much work costs by two slots of Slurm, as a
// ratio to two threads of one metamerd and Slurm's own start of a task; all in one run, turn by
// turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/cluster/cluster.h"
#include "tests/e2e/daemon.h"
#include "tests/e2e/scenes.h"

namespace metamer::test {
namespace {

double seconds_of(const std::function<void()>& work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// From the submission to the picture's end; looked for twice a second.
double render(const Daemon& server, const std::string& scene, int spp) {
  return seconds_of([&] {
    const std::string handle = server.submit(scene, {"--spp", std::to_string(spp)});
    const std::string job = handle.substr(0, handle.find('@'));
    for (std::string state; state != "finished"; state = server.job_state(job)) {
      if (state == "failed") std::exit(1);
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
  });
}

double start_of_a_task() {
  return seconds_of([] {
    (void)run({"/usr/bin/sbatch", "--wait", "--wrap", "true", "-o", "/dev/null"});
  });
}

}  // namespace

int bench(int turns, double work) {
  if (const std::string lacks = Cluster::lacks(); !lacks.empty()) {
    std::fprintf(stderr, "cluster_bench: %s\n", lacks.c_str());
    return 1;
  }
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", long_scene());
  const Daemon here(Daemon::Listens::unix_socket, {"--threads", "2", "--isa", "avx2"});
  constexpr int tried = 64;
  (void)render(here, scene, tried);  // what is done once is done
  const double two_threads = render(here, scene, tried);
  const int spp = std::clamp(static_cast<int>(tried * work / 2 / two_threads), 1, 4096);

  const Cluster cluster;
  const Daemon slurm(Daemon::Listens::unix_socket, cluster.words("10"));
  std::printf("%d samples a pixel, about %.0f s of work\n\n%8s %8s %8s %8s\n", spp, work, "threads",
              "Slurm", "start", "ratio");
  std::vector<double> by_threads, by_slurm, starts;
  for (int turn = 0; turn < turns; ++turn) {
    by_threads.push_back(render(here, scene, spp));
    by_slurm.push_back(render(slurm, scene, spp));
    starts.push_back(start_of_a_task());
    std::printf("%8.2f %8.2f %8.2f %8.3f\n", by_threads.back(), by_slurm.back(), starts.back(),
                by_slurm.back() / (by_threads.back() + starts.back()));
    std::fflush(stdout);
  }
  std::printf("\nmedians: Slurm / (threads + start) = %.3f\n",
              median(by_slurm) / (median(by_threads) + median(starts)));
  return 0;
}

}  // namespace metamer::test

int main(int count, char** words) {
  return metamer::test::bench(count > 1 ? std::max(1, std::atoi(words[1])) : 3,
                              count > 2 ? std::atof(words[2]) : 60);
}
