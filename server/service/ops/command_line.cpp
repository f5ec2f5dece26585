#include "server/service/ops/command_line.h"

#include <fmt/format.h>
#include <grp.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "common/wire/endpoint.h"
#include "common/wire/tls.h"
#include "server/service/ops/option_value.h"

namespace metamer::service {

namespace {

/// What is wrong with a word, as CLI11 wants it; empty: nothing.
std::string complaint(const Option& option, const std::string& word) {
  Settings scratch;
  const auto value = parse_words(option, {word});
  if (!value) return value.error().message;
  const auto given = set(option, scratch, *value);
  return given ? std::string() : given.error().message;
}

std::string help_text(const Option& option) {
  const Settings defaults;
  const auto value = toml_text(option, defaults);
  const bool flag = value_name(option).empty();
  return option.meaning + (value && !flag ? " (" + *value + ")" : "");
}

/// Declares a row of the table; its words are read from what this gives.
CLI::Option* declare(CLI::App& app, const Option& option) {
  const std::string name = "--" + option.name;
  CLI::Option* declared = nullptr;
  if (value_name(option).empty()) {
    declared = app.add_flag_function(
        name, [](std::int64_t) {}, help_text(option));
  } else {
    declared = app.add_option(name, CLI::callback_t([](const CLI::results_t&) { return true; }),
                              help_text(option));
    declared->type_name(value_name(option))
        ->check(
            CLI::Validator([&option](std::string& word) { return complaint(option, word); }, ""));
    if (is_list(option)) declared->take_all()->allow_extra_args(false);
  }
  return declared->group(option.section.empty() ? "Options" : "[" + option.section + "]");
}

constexpr mode_t readable_by_others = S_IRGRP | S_IROTH;

bool leads_beyond_this_machine(const wire::Endpoint& endpoint) {
  if (endpoint.kind != wire::Endpoint::Kind::tcp) return false;
  boost::system::error_code is_name;
  const auto address = boost::asio::ip::make_address(endpoint.host, is_name);
  return !is_name && !address.is_loopback();
}

std::vector<wire::Endpoint> endpoints_of(const Settings& settings) {
  std::vector<wire::Endpoint> endpoints;
  for (const std::string& text : settings.listen)
    if (const auto endpoint = wire::parse_endpoint(text)) endpoints.push_back(*endpoint);
  return endpoints;
}

}  // namespace

tl::expected<CommandLine, int> parse_command_line(int argc, const char* const* argv) {
  CommandLine line;
  CLI::App app(
      "The Metamer render service. Exit codes: 0 done, 1 failed, 2 a wrong command line "
      "or configuration.");
  app.set_version_flag("--version", "metamerd " METAMER_VERSION);
  std::string file = default_config_file, checked;
  auto* config =
      app.add_option("--config", file, "read this file first; the command line has the last word")
          ->expected(0, 1)
          ->type_name("[FILE]")
          ->capture_default_str();
  bool prints = false;
  auto* print = app.add_flag("--print-config", prints, "print the configuration in force, and end");
  auto* check = app.add_option("--check-config", checked,
                               "say what is wrong with this file, and end: 0 nothing, 2 something")
                    ->type_name("FILE")
                    ->excludes(config, print);
  std::vector<std::pair<const Option*, CLI::Option*>> declared;
  for (const Option& option : all_options()) declared.emplace_back(&option, declare(app, option));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return tl::unexpected(app.exit(error) == 0 ? exit_ok : exit_usage);
  }
  if (prints) line.task = CommandLine::Task::print_config;
  if (check->count() > 0) line.task = CommandLine::Task::check_config;
  if (check->count() > 0) line.config = checked;
  if (config->count() > 0) {
    line.config_is_default = config->results().front().empty();
    line.config = line.config_is_default ? default_config_file : file;
  }
  for (const auto& [option, words] : declared)
    if (words->count() > 0) line.words.emplace_back(option, words->results());
  return line;
}

tl::expected<Settings, Problems> settings_of(const CommandLine& line) {
  Settings settings;
  const bool absent = line.config_is_default && !std::filesystem::exists(*line.config);
  if (line.config && !absent) {
    if (auto read = read_config_file(*line.config, settings); !read)
      return tl::unexpected(read.error());
  }
  for (const auto& [option, words] : line.words) {
    const auto value = parse_words(*option, words);
    const auto given = value ? set(*option, settings, *value) : tl::unexpected(value.error());
    if (!given) return tl::unexpected(Problems{given.error()});
  }
  return settings;
}

Problems contradictions(const Settings& settings) {
  Problems found;
  const auto wrong = [&](std::string message) {
    found.push_back({.field = {}, .file = {}, .message = std::move(message)});
  };
  const ListenOptions& listening = settings.service.listening;
  const auto endpoints = endpoints_of(settings);
  for (const wire::Endpoint& endpoint : endpoints) {
    const std::string name = wire::to_string(endpoint);
    if (!endpoint.tls && !listening.insecure && leads_beyond_this_machine(endpoint))
      wrong(
          fmt::format("listen: what is said on {0} could be read on the way. Listen on tls:{0}, "
                      "or say --insecure",
                      name));
  }
  if (std::any_of(endpoints.begin(), endpoints.end(), [](const auto& one) { return one.tls; })) {
    if (listening.tls.certificate.empty() || listening.tls.key.empty()) {
      wrong("listen: TLS needs --tls-cert and --tls-key");
    } else if (const auto tls = wire::TlsContext::server(listening.tls, listening.client_ca);
               !tls) {
      wrong(tls.error().message);
    }
  }
  if (settings.service.executor == "slurm" && settings.service.slurm.folder.empty())
    wrong("executor: Slurm needs a folder that all nodes see: --slurm-folder");
  const std::string& group = listening.socket.group;
  if (!group.empty() && !::getgrnam(group.c_str()))
    wrong("socket-group: there is no group \"" + group + "\"");
  return found;
}

std::vector<std::string> cautions(const Settings& settings) {
  std::vector<std::string> found;
  const std::filesystem::path& key = settings.service.listening.tls.key;
  struct stat status {};
  if (!key.empty() && ::stat(key.c_str(), &status) == 0 && (status.st_mode & readable_by_others))
    found.push_back(
        fmt::format("tls-key: {} may be read by others than its owner (mode {:04o}), and whoever "
                    "has it can pass for this server: chmod 400",
                    key.string(), status.st_mode & 07777));
  const std::uint64_t most = settings.service.store_bytes + settings.service.keep_bytes;
  std::error_code unknown;
  const auto disk = std::filesystem::space(settings.state, unknown);
  if (!settings.state.empty() && !unknown && disk.capacity < most)
    found.push_back(fmt::format(
        "store-bytes and keep-bytes come to {} MiB, and the disk of {} has {} MiB: once it is "
        "full, assets that nobody holds make room and old pictures do not: jobs are refused",
        most >> 20, settings.state, disk.capacity >> 20));
  return found;
}

}  // namespace metamer::service
