#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

/// Real programs with their output captured, for tests that drive Metamer as a person does.
namespace metamer::test {

struct ProcessOptions {
  std::map<std::string, std::string> environment;  ///< In addition to ours.
  std::string folder;                              ///< Where it runs; empty: here.
  int parent_fd = -1;                              ///< Becomes its descriptor 3; -1: none.
};

/// What a program said and how it ended.
struct Ended {
  int code = -1;  ///< Exit code; 128 + the signal that ended it.
  std::string out;
  std::string err;
};

/// A running program. It is killed with its object.
class Process {
 public:
  /// `words[0]` is a path, or the name of one of Metamer's programs.
  explicit Process(std::vector<std::string> words, const ProcessOptions& options = {});
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  pid_t pid() const { return pid_; }
  void signal(int number) const;
  /// Reads until a line that contains `text` has come on stdout or stderr, and gives it; nothing
  /// when the program ended, or 30 s passed, without one. Lines before it are skipped for good.
  std::optional<std::string> line_out(const std::string& text);
  std::optional<std::string> line_err(const std::string& text);
  /// Waits for the end of its output and its own; kills it after 60 s.
  Ended wait();

 private:
  struct Pipe {
    int fd = -1;
    std::string text;
    std::size_t told = 0;  ///< Bytes that line() has gone past.
  };
  std::optional<std::string> line(Pipe& pipe, const std::string& text);
  bool read_some(int time_limit_ms);

  pid_t pid_ = -1;
  Pipe out_, err_;
};

/// Runs a program to its end.
Ended run(std::vector<std::string> words, const ProcessOptions& options = {});
/// `metamer` with these words.
Ended metamer(std::vector<std::string> words, const ProcessOptions& options = {});
/// That it ends with 2, and says this.
void expect_refused(const std::vector<std::string>& words, const std::string& message);

/// A process by its number, whoever started it.
class OtherProcess {
 public:
  explicit OtherProcess(pid_t pid);
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;
  ~OtherProcess();
  /// Waits up to 10 s; false: it still lives.
  bool ends() const;

 private:
  int fd_;
};

/// The processes that `pid` started and that still run.
std::vector<pid_t> children_of(pid_t pid);

/// A folder of the test's own, removed with it.
class Folder {
 public:
  Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder();
  std::string path() const { return path_; }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  /// Writes a file, with the folders that it needs; gives its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

}  // namespace metamer::test
