#pragma once

#include <cstdint>
#include <string>

#include "client/cli/commands.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/session/session.h"

namespace metamer::cli {

/// What pause and resume have in common: one request, answered with the job's new state.
using Control = boost::asio::awaitable<Answer<v1::JobSummary>> (Session::*)(std::uint64_t);

struct ControlOptions {
  CommonOptions common;
  std::string job;
  Control request = nullptr;
};

void declare_control(ControlOptions& values, Options& options);
ExitCode control(const ControlOptions& options);

template <Control request>
Command control_command(std::string name, std::string meaning) {
  return make_command<ControlOptions>(
      std::move(name), std::move(meaning),
      [](ControlOptions& values, Options& options) {
        values.request = request;
        declare_control(values, options);
      },
      control);
}

}  // namespace metamer::cli
