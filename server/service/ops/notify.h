#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

/// What a service manager is told, and what it gives: sd_notify(3), sd_watchdog_enabled(3). Where
/// none started the program, nothing happens.
namespace metamer::service::notify {

void ready();
void reloading();
/// It ends, which takes no longer: it is waited for, though a unit's TimeoutStopSec be shorter.
void stopping(std::chrono::milliseconds at_most);
/// A line for `systemctl status`, printable.
void status(const std::string& line);

/// Descriptors of sockets that it has bound for the program: sd_listen_fds(3).
std::vector<int> listening_descriptors();

/// How often alive() has to be said: half the unit's WatchdogSec; nothing: never.
std::optional<std::chrono::milliseconds> watchdog_interval();
void alive();

/// stderr goes to the journal, which has times and programs of its own (JOURNAL_STREAM, see
/// systemd.exec(5)).
bool logs_to_journal();

}  // namespace metamer::service::notify
