#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// What a process that reads what strangers made may still do: compute, read one folder, and talk
/// over the descriptors that it was given.
namespace metamer::sandbox {

/// What a confined process may start.
enum class Children {
  none,    ///< Threads.
  forked,  ///< Copies of itself as well, which are confined alike, and end them.
};

/// How well this system confines. `kinds`: "landlock 6, seccomp", newest features first; `lacks`:
/// what is missing and why, empty where nothing of importance is.
struct Confinement {
  std::string kinds;
  std::string lacks;
};

/// "landlock 6, seccomp", "seccomp only; landlock: Function not implemented".
std::string describe(const Confinement& confinement);

/// The device nodes that this process has open above descriptor `last_given`: those of its GL
/// driver. Drivers open them anew for each piece of memory.
std::vector<std::filesystem::path> open_devices(int last_given);

/// Before a GL driver is loaded and starts its threads, which no later rule over files reaches:
/// this process and they can still open every file that exists, for writing those below /dev alone;
/// nothing is made, cut short, moved or removed. Where the system knows no such rules, nothing.
void confine_driver();

/// Confines all threads of this process before it parses anything. It can read below `store` and
/// use `devices`. No other file is opened, changed, made or removed; no socket is made or
/// connected; no program is run; no process outside is signalled or looked into; no privileges are
/// gained; it leaves no core, and dies with its parent. Threads that were started before are held
/// to all of it but the files that they can read: see confine_driver().
Confinement enter(const std::filesystem::path& store,
                  const std::vector<std::filesystem::path>& devices = {},
                  Children children = Children::none);

}  // namespace metamer::sandbox
