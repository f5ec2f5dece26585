#pragma once

#include <cstdio>
#include <cstdlib>

namespace metamer::fuzz {

/// What has to hold whatever the input is.
inline void check(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", what);
  std::abort();
}

}  // namespace metamer::fuzz
