#pragma once

#include <string>

namespace metamer::service {

/// What the names of all tasks of one server begin with: of its identity (JobStore::server_id), or
/// where it has none of what it draws now.
std::string task_prefix(const std::string& server_id);

/// A name that never comes twice: `prefix`, and 128 bits of the system's randomness.
std::string new_task_name(const std::string& prefix);

}  // namespace metamer::service
