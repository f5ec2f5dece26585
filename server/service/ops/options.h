#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "server/service/service.h"

/// The options of metamerd, in one table: --help, metamerd.toml, the man pages and what may change
/// while it runs are all made from it.
namespace metamer::service {

/// What the options say. A value that nobody sets is the member's own.
struct Settings {
  ServiceOptions service;           ///< All but listen, store and the worker's program.
  std::vector<std::string> listen;  ///< Empty: default_endpoint().
  std::string state;                ///< Empty: nothing is kept.
  std::string store;                ///< Empty: the state's, or a temporary folder.
  std::string worker;               ///< Empty: default_worker().
  std::optional<std::uint64_t> first_job;
  std::optional<std::uint64_t> parent_fd;
  std::string socket_mode = "0600";  ///< Of Unix sockets; see socket_mode_of().
  std::string log_level = "info";
  std::string log_format = "text";
  std::string metrics_file;  ///< Empty: none.
  std::chrono::milliseconds drain_time{10'000};
};

/// Where an option's value lies. An empty text, an empty list and an empty optional are values that
/// nobody has set.
using OptionTarget = std::variant<bool*, std::uint32_t*, std::uint64_t*,
                                  std::optional<std::uint64_t>*, std::chrono::milliseconds*,
                                  std::string*, std::filesystem::path*, std::vector<std::string>*>;

enum class Unit { none, bytes, seconds };

/// A row of the table.
struct Option {
  std::string name;     ///< "store-bytes": --store-bytes, and the key in its section of the file.
  std::string section;  ///< "store"; empty: on the command line alone.
  std::string meaning;  ///< One sentence, of --help and of the file's comment, without a full stop.
  OptionTarget (*at)(Settings&);
  Unit unit = Unit::none;
  double min = 0;  ///< Of a number; both inclusive, in the unit.
  double max = 0;
  std::vector<std::string> words = {};                  ///< That a text may be; empty: any.
  Result<void> (*check)(const std::string&) = nullptr;  ///< Of a text, or each of a list.
  bool reloads = false;  ///< SIGHUP changes it; otherwise it needs a restart.
};

/// A part of the file.
struct Section {
  std::string name;
  std::string meaning;
};

/// The rows, those of one section together, in the order of the file.
const std::vector<Option>& all_options();
/// In the same order.
const std::vector<Section>& all_sections();

}  // namespace metamer::service
