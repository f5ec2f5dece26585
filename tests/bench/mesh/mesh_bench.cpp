// mesh_bench [LARGEST [TURNS]]: how fast and in how much memory meshes are read, by format and
// size. Prints ratios to a plain read of the same file, and asserts nothing.

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "common/mesh/mesh_file.h"
#include "grid_files.h"

namespace metamer {
namespace {

/// What a task took in a process of its own.
struct Cost {
  double seconds = 0, cpu = 0;
  double bytes = 0;  ///< The largest memory, what a process without a task has taken off.
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Cost cost_of(const std::function<void()>& task) {
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    task();
    _exit(0);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (status != 0) std::exit(1);
  return {
      .seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
      .cpu = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime),
      .bytes = 1024.0 * static_cast<double>(usage.ru_maxrss)};
}

void read_plainly(const std::filesystem::path& path) {
  std::vector<char> bytes(std::filesystem::file_size(path));
  const int file = open(path.c_str(), O_RDONLY);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t size = read(file, bytes.data() + done, bytes.size() - done);
    if (size <= 0) _exit(1);
    done += static_cast<std::size_t>(size);
  }
}

Bytes mapped(const std::filesystem::path& path) {
  const std::size_t size = std::filesystem::file_size(path);
  const int file = open(path.c_str(), O_RDONLY);
  void* const memory = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file, 0);
  if (memory == MAP_FAILED) _exit(1);
  std::shared_ptr<const void> owner(memory, [memory, size](const void*) { munmap(memory, size); });
  return {std::move(owner), {static_cast<const char*>(memory), size}};
}

void import(const std::filesystem::path& path) {
  auto file = read_mesh(path, [&](const std::string&) -> Result<Bytes> { return mapped(path); });
  const auto mesh = file ? triangles_of(*std::move(file), {}) : tl::unexpected(file.error());
  if (mesh) return;
  std::printf("%s\n", format(mesh.error()).c_str());
  _exit(1);
}

/// The least of each over some turns that take each other's place.
void measure(GridFormat format, bool normals, std::size_t megabytes, int turns) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("mesh_bench." + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto path = write_grid(format, normals, megabytes * 1'000'000, folder);
  const double size = static_cast<double>(std::filesystem::file_size(path));
  const double base = cost_of([] {}).bytes;
  Cost plain{1e9, 1e9, 1e18}, mesh = plain;
  const auto keep_least = [](Cost& least, const Cost& cost) {
    least = {std::min(least.seconds, cost.seconds), std::min(least.cpu, cost.cpu),
             std::min(least.bytes, cost.bytes)};
  };
  for (int turn = 0; turn < turns; ++turn) {
    keep_least(plain, cost_of([&] { read_plainly(path); }));
    keep_least(mesh, cost_of([&] { import(path); }));
  }
  std::printf("%-11s %-8s %6.1f %8.0f %8.0f %8.1f %8.1f %8.2f\n", format_name(format).c_str(),
              normals ? "normals" : "-", size / 1e6, size / 1e6 / plain.seconds,
              size / 1e6 / mesh.seconds, mesh.seconds / plain.seconds, mesh.cpu / plain.cpu,
              (mesh.bytes - base) / size);
  std::fflush(stdout);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace metamer

int main(int count, char** arguments) {
  const std::size_t largest = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 100;
  const int turns = count > 2 ? std::atoi(arguments[2]) : 3;
  std::printf("                             MB/s     MB/s  seconds      CPU   memory\n");
  std::printf("format      with         MB   plain   import  / plain  / plain   / file\n");
  for (const auto format : {metamer::GridFormat::ply, metamer::GridFormat::ply_text,
                            metamer::GridFormat::obj, metamer::GridFormat::glb})
    for (const std::size_t megabytes : {1u, 10u, 100u, 500u})
      for (const bool normals : {true, false})
        if (megabytes <= largest) metamer::measure(format, normals, megabytes, turns);
}
