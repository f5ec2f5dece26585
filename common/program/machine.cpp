#include "common/program/machine.h"

#include <unistd.h>

#include <array>
#include <fstream>

namespace metamer {

std::string host_name() {
  std::array<char, 65> name{};
  (void)::gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (const auto colon = line.find(": "); line.starts_with("model name") && colon != line.npos)
      return line.substr(colon + 2);
  return {};
}

}  // namespace metamer
