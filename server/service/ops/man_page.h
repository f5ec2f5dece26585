#pragma once

#include <string>

/// The man pages of the daemon, from the table of options.
namespace metamer::service {

/// metamerd(8) as roff: synopsis, options, signals, exit codes, files.
std::string metamerd_man_page();
/// metamerd.toml(5): each section, each key with its values.
std::string config_man_page();

}  // namespace metamer::service
