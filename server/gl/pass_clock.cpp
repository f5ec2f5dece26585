#include "server/gl/pass_clock.h"

#include <epoxy/gl.h>

#include <chrono>

namespace metamer::gl {

const char* name_of(Pass pass) {
  switch (pass) {
    case Pass::places:
      return "places";
    case Pass::visibility:
      return "visibility";
    case Pass::shading:
      return "shading";
    case Pass::color:
      return "color";
  }
  return "";
}

PassClock::PassClock(bool timers) {
  if (timers) glCreateQueries(GL_TIME_ELAPSED, 1, &query_);
}

PassClock::~PassClock() {
  if (query_ != 0) glDeleteQueries(1, &query_);
}

void PassClock::run(Pass pass, const std::function<void()>& calls) {
  double& sum = seconds_[static_cast<std::size_t>(pass)];
  if (query_ != 0) {
    GLuint64 nanoseconds = 0;
    glBeginQuery(GL_TIME_ELAPSED, query_);
    calls();
    glEndQuery(GL_TIME_ELAPSED);
    glGetQueryObjectui64v(query_, GL_QUERY_RESULT, &nanoseconds);  // waits
    sum += static_cast<double>(nanoseconds) * 1e-9;
    return;
  }
  const auto start = std::chrono::steady_clock::now();
  calls();
  glFinish();
  sum += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace metamer::gl
