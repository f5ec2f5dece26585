#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "cluster.h"
#include "tests/e2e/daemon.h"
#include "tests/e2e/scenes.h"

namespace metamer::test {

/// Jobs by a cluster of the test's own, beside the same by this machine.
class ClusterTest : public testing::Test {
 protected:
  ClusterTest() : ClusterTest(Cluster::Shape{}) {}
  explicit ClusterTest(const Cluster::Shape& shape) : shape_(shape) {}
  void SetUp() override {
    const std::string lacks = shape_.apart ? Cluster::lacks_apart() : Cluster::lacks();
    if (!lacks.empty()) GTEST_SKIP() << lacks;
    cluster_ = std::make_unique<Cluster>(shape_);
  }

  std::unique_ptr<Daemon> daemon(const std::string& task_time = "1",
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = cluster_->words(task_time);
    words.insert(words.end(), more.begin(), more.end());
    return std::make_unique<Daemon>(Daemon::Listens::unix_socket, words);
  }
  /// The job's number, without its server.
  static std::string submit(const Daemon& server, const std::string& scene,
                            const std::vector<std::string>& settings = {}) {
    const std::string handle = server.submit(scene, settings);
    return handle.substr(0, handle.find('@'));
  }
  /// What a server has counted: "metamer_tiles_total" of "backend=\"cpu\"".
  static double count(const Daemon& server, const std::string& name, const std::string& label) {
    const Json answer = server.json({"stats"});
    for (const Json& one : answer["metric"])
      if (one["name"] == name && one["label"] == label) return one["value"];
    ADD_FAILURE() << name << " is not counted";
    return 0;
  }
  struct Here {
    Image image;
    double tiles = 0, rays = 0;
  };
  /// By this machine, which uses no more of its processor than any node, and what it counts.
  Here counted_here(const std::string& scene, const std::vector<std::string>& settings) {
    const Daemon server(Daemon::Listens::unix_socket, {"--isa", "avx2"});
    Here here;
    here.image = fetched(server, submit(server, scene, settings));
    here.tiles = count(server, "metamer_tiles_total", "backend=\"cpu\"");
    here.rays = count(server, "metamer_rays_total", "backend=\"cpu\"");
    return here;
  }
  Image here(const std::string& scene, const std::vector<std::string>& settings) {
    return counted_here(scene, settings).image;
  }
  /// A server that has had one job has made its picture, and taken each of its tiles once.
  void expect_once(const Here& here, const Daemon& server, const std::string& job,
                   const std::string& what) {
    expect_same_pixels(here.image, fetched(server, job), what);
    EXPECT_EQ(count(server, "metamer_tiles_total", "backend=\"cpu\""), here.tiles) << what;
    EXPECT_EQ(count(server, "metamer_rays_total", "backend=\"cpu\""), here.rays) << what;
  }
  /// Of a job, once it has ended.
  Image fetched(const Daemon& server, const std::string& job) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(540);
    for (std::string state; state != "finished" && state != "failed";
         state = server.job_state(job)) {
      if (std::chrono::steady_clock::now() > end) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      cluster_->resume_nodes();
    }
    const std::string file = folder_ / ("fetched" + std::to_string(++count_) + ".exr");
    const Ended ended = server.metamer({"fetch", job, "-o", file, "--exr", "xyz"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.code == 0 ? read_exr(file) : Image{};
  }
  /// Until some of the picture is there.
  static void wait_for_tiles(const Daemon& server, const std::string& job) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      const Json answer = server.json({"jobs"});
      for (const Json& one : answer["jobs"])
        if (std::to_string(one["job_id"].get<std::uint64_t>()) == job && one["tiles_done"] > 0)
          return;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << "no tile has come";
  }
  void wait_for_workers(std::size_t count) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (cluster_->workers().size() < count && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_GE(cluster_->workers().size(), count);
  }

  /// A turntable of the booth, by the cluster and by this machine: the same frames, bit for bit.
  void turn(int frames, const std::vector<std::string>& settings) {
    const auto turned = [&](const Daemon& server, const std::string& name) {
      std::vector<std::string> words = {
          "turntable", METAMER_TEST_DATA "/../deploy/booth/booth.txtpb",
          "--frames",  "0:" + std::to_string(frames - 1),
          "--count",   "200",
          "-o",        folder_ / (name + "-%d.exr"),
          "--exr",     "xyz"};
      words.insert(words.end(), settings.begin(), settings.end());
      return server.json(words);
    };
    turned(Daemon(Daemon::Listens::unix_socket, {"--isa", "avx2"}), "here");
    const auto server = daemon("0.05");
    const Json answer = turned(*server, "there");
    EXPECT_EQ(answer["series"]["done"], frames) << answer;
    for (const Json& frame : answer["frames"]) {
      const std::string number = std::to_string(frame["frame"].get<int>()) + ".exr";
      expect_same_pixels(read_exr(folder_ / ("here-" + number)),
                         read_exr(folder_ / ("there-" + number)), number);
      // Each tile is some node's.
      const Json record = server->json({"jobs", "--record", frame["handle"]});
      std::uint64_t tiles = 0;
      for (const Json& machine : record["record"]["machine"]) {
        EXPECT_EQ(machine["name"].get<std::string>().front(), 'n') << machine;
        tiles += machine["tiles"].get<std::uint64_t>();
      }
      EXPECT_GT(tiles, 0u);
      EXPECT_EQ(record["record"], frame["record"]);
    }
  }

  static bool within(int seconds, const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
    while (!holds()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
  }

  Folder folder_;
  Cluster::Shape shape_;
  std::unique_ptr<Cluster> cluster_;
  int count_ = 0;
};

}  // namespace metamer::test
