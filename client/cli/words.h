#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "client/cli/commands.h"
#include "client/cli/options.h"

/// The command line's words. These files alone (words*.cpp, main.cpp) include CLI11, which takes
/// seconds to compile.
namespace metamer::cli {

/// What a subcommand does when it was chosen.
using Action = std::function<ExitCode()>;

/// The exit codes, under every --help.
extern const char* const footer;

CLI::App& add_command(CLI::App& app, const char* name, const char* meaning, Action& chosen,
                      const Action& action);

void add_json(CLI::App& command, bool& json);
void add_common(CLI::App& command, CommonOptions& options);
void add_scene(CLI::App& command, std::string& scene);
void add_job(CLI::App& command, std::uint64_t& job_id);
void add_overrides(CLI::App& command, Overrides& options);
void add_development(CLI::App& command, DevelopmentOptions& options, const char* group);
/// -o and --exr.
void add_picture_files(CLI::App& command, OutputOptions& options);
/// The same and --keep-factors.
void add_output(CLI::App& command, OutputOptions& options);

/// `metamer spectra` and all below it.
void add_spectra_commands(CLI::App& app, SpectraCommands& all, Action& chosen);
void add_relight(CLI::App& app, RelightOptions& options, Action& chosen);
void add_compare(CLI::App& app, CompareOptions& options, Action& chosen);
void add_tradeoff(CLI::App& app, TradeoffOptions& options, Action& chosen);

}  // namespace metamer::cli
