#include "running_job.h"

#include <gtest/gtest.h>

namespace metamer::test {

RunningJob::RunningJob(const Daemon& daemon, const std::string& scene)
    : id_(daemon.submit(folder_.write("scene.txtpb", scene))),
      watcher_(daemon.start({"watch", id_, "--json"})) {
  // The first progress may come before the first tile.
  for (Json progress = event("\"progress\""); !progress.is_null(); progress = event("\"progress\""))
    if (progress["progress"]["tiles_done"] > 0) return;
  ADD_FAILURE() << "the job made no progress";
}

Json RunningJob::event(const std::string& text) {
  const std::optional<std::string> line = watcher_->line_out(text);
  return line ? parse_document(*line) : Json(nullptr);
}

RunningJob::End RunningJob::end() {
  const Ended ended = watcher_->wait();
  const std::string lines = ended.out.substr(0, ended.out.find_last_not_of('\n') + 1);
  const std::size_t begin = lines.find_last_of('\n');
  return {ended.code, parse_document(begin == std::string::npos ? lines : lines.substr(begin + 1)),
          lines};
}

}  // namespace metamer::test
