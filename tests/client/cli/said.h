#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "client/cli/exit_code.h"

namespace metamer::cli {

/// What a command line said and came to.
struct Said {
  ExitCode code;
  std::string out, err;
  nlohmann::ordered_json json() const { return nlohmann::ordered_json::parse(out); }
};

/// `metamer WORDS…`, in this process.
Said say(const std::vector<std::string>& words);

}  // namespace metamer::cli
