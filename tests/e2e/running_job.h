#pragma once

#include <memory>
#include <string>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {

/// A job on a daemon, in the middle of it: some of its tiles are done, most are not.
class RunningJob {
 public:
  explicit RunningJob(const Daemon& daemon, const std::string& scene = long_scene());

  const std::string& id() const { return id_; }
  /// Reads the watched events until one that contains `text` has come; null: none came.
  Json event(const std::string& text);
  /// All the events up to the last one, and the watcher's exit code.
  struct End {
    int code;
    Json last;
    std::string events;
  };
  End end();

 private:
  Folder folder_;
  std::string id_;
  std::unique_ptr<Process> watcher_;
};

}  // namespace metamer::test
