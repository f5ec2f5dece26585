// A disk that has what was synced and nothing else, for a program that is started with this as
// LD_PRELOAD:
//
//     METAMER_DISK          the folder that it is about
//     METAMER_DISK_SHADOW   where it notes what a power cut would leave (read by forgetful_disk.h)
//     METAMER_DISK_CUT      at which fsync the power is cut, before that has an effect; 0: never
//     METAMER_DISK_FULL     a file: while it is there, there is no room (ENOSPC); with a number in
//     it, until so
//                           many files that are not empty were removed
//     METAMER_DISK_BROKEN   a file: while it is there, nothing can be synced (EIO)
//
// It is stricter than most file systems: a name is there only once its folder was synced. A file is
// told from a later one of the same inode number by the time of its birth.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>

namespace {

namespace fs = std::filesystem;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

const fs::path& folder() {
  static const fs::path only = variable("METAMER_DISK");
  return only;
}

/// Its file, where that is on this disk.
fs::path path_of(int fd) {
  std::error_code error;
  fs::path path = fs::read_symlink("/proc/self/fd/" + std::to_string(fd), error);
  return !error && path.string().rfind(folder().string(), 0) == 0 ? path : fs::path();
}

/// Asked by each write, those that begin() makes included: it knows nothing of disk().
bool has_room(int fd) {
  static const std::string full = variable("METAMER_DISK_FULL");
  return full.empty() || ::access(full.c_str(), F_OK) != 0 || path_of(fd).empty();
}

/// Before a file of this disk is removed.
void note_removal(const char* path) {
  static const fs::path full = variable("METAMER_DISK_FULL");
  std::error_code error;
  if (full.empty() || std::string(path).rfind(folder().string(), 0) != 0 ||
      !fs::is_regular_file(path, error) || fs::file_size(path, error) == 0)
    return;
  int left = 0;
  if (!(std::ifstream(full) >> left)) return;
  if (--left == 0)
    fs::rename(full, full.string() + ".past", error);
  else
    std::ofstream(full) << left;
}

struct ForgetfulDisk {
  fs::path disk = folder();
  fs::path shadow = variable("METAMER_DISK_SHADOW");
  fs::path broken = variable("METAMER_DISK_BROKEN");
  int cut = std::atoi(variable("METAMER_DISK_CUT").c_str());
  int syncs = 0;
  std::mutex mutex;

  /// Whose name it is, whatever it is called.
  static std::string key(const fs::path& path) {
    struct statx status {};
    if (::statx(AT_FDCWD, path.c_str(), AT_SYMLINK_NOFOLLOW, STATX_INO | STATX_BTIME, &status) != 0)
      return "gone";
    return std::to_string(status.stx_ino) + "-" + std::to_string(status.stx_btime.tv_sec) + "-" +
           std::to_string(status.stx_btime.tv_nsec);
  }

  void note_file(const fs::path& path) const {
    const fs::path to = shadow / key(path), half = shadow / "half";
    std::error_code error;
    fs::copy_file(path, half, fs::copy_options::overwrite_existing, error);
    if (!error) fs::rename(half, to, error);
  }

  void note_folder(const fs::path& path) const {
    const fs::path half = shadow / "half";
    std::ofstream list(half, std::ios::trunc);
    std::error_code error;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end;
         entry.increment(error))
      if (entry->is_regular_file(error) || entry->is_directory(error))
        list << (entry->is_directory(error) ? "folder " : "file ") << key(entry->path()) << ' '
             << entry->path().filename().string() << '\n';
    list.close();
    fs::rename(half, shadow / (key(path) + ".folder"), error);
  }

  /// What was there when the program began is on the disk.
  void begin() {
    if (shadow.empty() || fs::exists(shadow / "root")) return;
    std::ofstream(shadow / "root") << key(disk);
    note_folder(disk);
    std::error_code error;
    for (fs::recursive_directory_iterator entry(disk, error), end; !error && entry != end;
         entry.increment(error)) {
      if (entry->is_directory(error)) note_folder(entry->path());
      if (entry->is_regular_file(error)) note_file(entry->path());
    }
  }

  bool sync(int fd) {
    const fs::path path = path_of(fd);
    if (path.empty()) return true;
    if (!broken.empty() && ::access(broken.c_str(), F_OK) == 0) return false;
    if (shadow.empty()) return true;
    const std::lock_guard guard(mutex);
    if (++syncs == cut) {
      ::kill(::getpid(), SIGKILL);
      for (;;) ::pause();
    }
    std::error_code error;
    if (fs::is_directory(path, error))
      note_folder(path);
    else
      note_file(path);
    return true;
  }
};

ForgetfulDisk& disk() {
  static ForgetfulDisk* const only = [] {
    auto* made = new ForgetfulDisk;
    made->begin();
    return made;
  }();
  return *only;
}

[[gnu::constructor]] void begin() { disk(); }

}  // namespace

/// The function of this name that the program would have without this.
template <class Function>
Function* other(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int fail(int error) {
  errno = error;
  return -1;
}

extern "C" int fsync(int fd) { return disk().sync(fd) ? 0 : fail(EIO); }

extern "C" int fdatasync(int fd) { return disk().sync(fd) ? 0 : fail(EIO); }

extern "C" int unlink(const char* path) noexcept {
  static auto* const real = other<int(const char*)>("unlink");
  note_removal(path);
  return real(path);
}

extern "C" int remove(const char* path) noexcept {
  static auto* const real = other<int(const char*)>("remove");
  note_removal(path);
  return real(path);
}

extern "C" ssize_t write(int fd, const void* bytes, size_t size) {
  static auto* const real = other<ssize_t(int, const void*, size_t)>("write");
  return has_room(fd) ? real(fd, bytes, size) : fail(ENOSPC);
}

extern "C" ssize_t pwrite(int fd, const void* bytes, size_t size, off_t offset) {
  static auto* const real = other<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  return has_room(fd) ? real(fd, bytes, size, offset) : fail(ENOSPC);
}

extern "C" ssize_t pwrite64(int fd, const void* bytes, size_t size, off64_t offset) {
  static auto* const real = other<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  return has_room(fd) ? real(fd, bytes, size, offset) : fail(ENOSPC);
}
