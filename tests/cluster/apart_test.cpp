// A node that is cut off while it works, and one that can write nothing: what they were to do is
// done elsewhere, and counts once.
#include <gtest/gtest.h>
#include <signal.h>

#include "cluster_fixture.h"

namespace metamer::test {
namespace {

class LongApartOnSlurm : public ClusterTest {
 protected:
  LongApartOnSlurm() : ClusterTest({.apart = true}) {}
  pid_t task_on(const std::string& node, const std::vector<pid_t>& but = {}) const {
    pid_t found = 0;
    const bool there = within(90, [&] {
      for (const pid_t pid : cluster_->tasks_on(node))
        if (std::find(but.begin(), but.end(), pid) == but.end()) found = pid;
      return found != 0;
    });
    EXPECT_TRUE(there) << "no task on " << node;
    return found;
  }
  std::string scene_ = folder_.write("scene.txtpb", long_scene());
};

/// A range's first attempt is held on the node that is cut off, until another node has the same
/// range; then both go on, in either order, and both leave their result.
TEST_F(LongApartOnSlurm, RangeThatTwoNodesRenderAtOnceCountsOnce) {
  const Here local = counted_here(scene_, {"--spp", "64"});
  const auto server = daemon("2");
  const std::string job = submit(*server, scene_, {"--spp", "64"});
  wait_for_tiles(*server, job);
  const pid_t first = task_on("n2");
  ASSERT_GT(first, 0);
  kill(first, SIGSTOP);
  cluster_->cut_off();
  // Slurm takes the node for dead after ten seconds, and the range goes to the other one.
  const auto lost = [&] {
    return count(*server, "metamer_worker_losses_total", "worker=\"cpu by Slurm\"") >= 1;
  };
  EXPECT_TRUE(within(90, lost));
  EXPECT_EQ(kill(first, 0), 0) << "both are alive";
  kill(first, SIGCONT);
  expect_once(local, *server, job, "a node that was cut off");
  cluster_->reconnect();
  const std::string next = submit(*server, scene_, {"--spp", "4"});
  expect_same_pixels(here(scene_, {"--spp", "4"}), fetched(*server, next), "and came back");
}

TEST_F(LongApartOnSlurm, FullDiskOfANodeLosesNothing) {
  const Here local = counted_here(scene_, {"--spp", "128"});
  cluster_->fill_disk();
  const auto server = daemon("1");
  const std::string job = submit(*server, scene_, {"--spp", "128"});
  EXPECT_TRUE(within(200, [&] {
    const std::string state = server->job_state(job);
    return state == "finished" || state == "failed";
  }));
  if (server->job_state(job) == "finished") {
    expect_once(local, *server, job, "the other node has done it");
  } else {
    const Ended jobs = server->metamer({"jobs"});
    EXPECT_NE(jobs.out.find("No space left on device"), std::string::npos) << jobs.out;
  }
  EXPECT_GE(count(*server, "metamer_worker_losses_total", "worker=\"cpu by Slurm\""), 1);
  cluster_->make_room();
  const std::string next = submit(*server, scene_, {"--spp", "128"});
  expect_same_pixels(local.image, fetched(*server, next), "with room again");
}

}  // namespace
}  // namespace metamer::test
