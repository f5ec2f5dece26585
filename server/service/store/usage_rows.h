#pragma once

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

}  // namespace metamer::service
