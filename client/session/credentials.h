#pragma once

#include <filesystem>
#include <string>

#include "common/problem.h"

namespace metamer::client {

/// What `metamer login` keeps of one server: who the user is there, and how the server is known
/// where the system's authorities do not know it.
struct Credentials {
  std::string token;
  std::string authorities;  ///< A PEM file.
  std::string fingerprint;  ///< SHA-256 of its certificate, 64 hexadecimal digits.
  // A client's certificate and its key, PEM files.
  std::string certificate, key;

  bool operator==(const Credentials&) const = default;
};

/// servers.toml in $XDG_CONFIG_HOME/metamer, else in ~/.config/metamer: a table for each server, by
/// its address as wire::to_string writes it.
std::filesystem::path credentials_file();

/// Those of a server; empty ones where none are kept. Errors: a file that others may read, since
/// tokens stand in it, or that is none of ours.
Result<Credentials> kept_credentials(const std::string& server);

/// Keeps them in place of those before; empty ones: nothing is kept. The file is its user's alone
/// to read, and is replaced as a whole. Errors: those of kept_credentials, the system's.
Result<void> keep_credentials(const std::string& server, const Credentials& credentials);

}  // namespace metamer::client
