#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "metamer/v1/scene.pb.h"
#include "server/service/store/database.h"

namespace metamer::service {

/// How far a user is ahead of the turn under way on a backend's worker: seconds of a user of share
/// 1 (schedule/fair_share).
struct KeptLead {
  v1::Backend backend = v1::CPU;
  std::string user;
  double seconds = 0;
};

/// Those of one backend, in the place of what was kept of it. Throws DatabaseError.
void write_leads(Database& database, v1::Backend backend, const std::vector<KeptLead>& leads);
std::vector<KeptLead> read_leads(Database& database);

/// What workers spent on a user's jobs in an hour, of those since 1970 (schedule/work_ledger).
struct KeptWork {
  std::string user;
  std::int64_t hour = 0;
  double seconds = 0;
};

/// Each in the place of what was kept of that hour; what is of hours before `first` is forgotten.
void write_work(Database& database, const std::vector<KeptWork>& work, std::int64_t first);
std::vector<KeptWork> read_work(Database& database);

}  // namespace metamer::service
