// A worker whose memory is at its end says so by its exit code, whatever asked for more.

#include "server/worker/out_of_memory.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

#include "common/wire/worker_exit.h"
#include "server/cpu/embree_scene.h"
#include "tests/server/test_scene.h"

namespace metamer::worker {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;  // Its shadow counts as memory.
#else
constexpr bool sanitized = false;
#endif

/// This process may have so many bytes more.
void allow(std::uint64_t more) {
  std::ifstream status("/proc/self/status");
  std::uint64_t has = 0;
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmData:")) has = std::stoull(line.substr(7)) << 10;
  rlimit limit{};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = has + more;
  setrlimit(RLIMIT_DATA, &limit);
}

class OutOfMemory : public testing::Test {
 protected:
  void SetUp() override {
    if (sanitized) GTEST_SKIP();
    GTEST_FLAG_SET(death_test_style, "threadsafe");
  }
};

constexpr std::uint64_t mebi = 1 << 20;
const auto says_so = testing::ExitedWithCode(wire::exit_out_of_memory);

/// A grid of a million triangles, whose hierarchy takes about 60 MiB.
RenderScene fine_grid() {
  RenderScene scene = test::compile_text(
      "camera { eye { z: 5 } target {} vertical_fov: 30 } light { direction { z: -1 } spectrum { "
      "constant: 1 } } material { name: 'm' diffuse { constant: 1 } } object { name: 'o' material: "
      "'m' quad { corner {} u { x: 1 } v { y: 1 } } }");
  constexpr std::uint32_t side = 708;
  std::vector<Float3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x)
      positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t at = y * (side + 1) + x;
      triangles.push_back({at, at + 1, at + side + 2});
      triangles.push_back({at, at + side + 2, at + side + 1});
    }
  scene.meshes[0].positions = Array<Float3>(std::move(positions));
  scene.meshes[0].triangles = std::move(triangles);
  scene.meshes[0].normals = {};
  return scene;
}

TEST_F(OutOfMemory, OfOperatorNewEndsTheWorker) {
  EXPECT_EXIT(
      {
        end_when_out_of_memory();
        allow(16 * mebi);
        std::vector<std::vector<char>> all;
        while (all.size() < 1024) all.emplace_back(mebi, '\1');
      },
      says_so, "");
}

TEST_F(OutOfMemory, InAnyThreadAndThrownByALibrary) {
  EXPECT_EXIT(
      {
        end_when_out_of_memory();
        std::thread([] { throw std::bad_alloc(); }).join();
      },
      says_so, "");
}

TEST_F(OutOfMemory, OfEmbreesHierarchyEndsTheWorker) {
  EXPECT_EXIT(
      {
        end_when_out_of_memory();
        const RenderScene scene = fine_grid();
        const std::atomic<bool> never = false;
        allow(32 * mebi);
        std::thread([&] { cpu::EmbreeScene::build(scene, never); }).join();
        std::_Exit(0);
      },
      says_so, "");
}

TEST_F(OutOfMemory, WhatElseIsThrownIsNotTakenForIt) {
  EXPECT_EXIT(
      {
        end_when_out_of_memory();
        std::thread([] { throw 1; }).join();
      },
      testing::KilledBySignal(SIGABRT), "");
}

}  // namespace
}  // namespace metamer::worker
