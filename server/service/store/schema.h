#pragma once

#include <string>

#include "common/problem.h"
#include "server/service/store/database.h"

namespace metamer::service {

/// In the folder of the daemon's state.
inline constexpr const char* database_name = "metamer.db";

/// The version of the tables that this program writes.
extern const int schema_version;

/// Makes the tables, or brings those of an earlier version up to date, in one transaction. Errors:
/// a database of a later version, or of another program. Throws DatabaseError.
Result<void> migrate(Database& database);

/// For who only reads. Errors: a database of another version, or of another program. Throws
/// DatabaseError.
Result<void> check_version(Database& database);

/// The 16 random bytes that name this state for ever. Throws DatabaseError.
std::string server_id(Database& database);

}  // namespace metamer::service
