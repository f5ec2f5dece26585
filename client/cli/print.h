#pragma once

#include "client/tools/formatted.h"

namespace metamer::cli {

template <class... Values>
std::string print(const char* format, Values... values) {
  return client::formatted(format, values...);
}

}  // namespace metamer::cli
