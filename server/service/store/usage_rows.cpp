#include "server/service/store/usage_rows.h"

#include <cmath>

namespace metamer::service {

void write_leads(Database& database, v1::Backend backend, const std::vector<KeptLead>& leads) {
  database.prepare("DELETE FROM leads WHERE backend=?").bind(1, std::int64_t{backend}).run();
  Statement put = database.prepare("INSERT INTO leads(backend, user, seconds) VALUES(?, ?, ?)");
  for (const KeptLead& lead : leads)
    put.bind(1, std::int64_t{backend}).bind(2, lead.user).bind(3, lead.seconds).run();
}

std::vector<KeptLead> read_leads(Database& database) {
  std::vector<KeptLead> leads;
  Statement all = database.prepare("SELECT backend, user, seconds FROM leads");
  while (all.step()) {
    const std::int64_t backend = all.integer(0);
    if (!v1::Backend_IsValid(static_cast<int>(backend)) || !std::isfinite(all.real(2))) continue;
    leads.push_back({static_cast<v1::Backend>(backend), all.bytes(1), all.real(2)});
  }
  return leads;
}

void write_work(Database& database, const std::vector<KeptWork>& work, std::int64_t first) {
  database.prepare("DELETE FROM work WHERE hour<?").bind(1, first).run();
  Statement put =
      database.prepare("INSERT OR REPLACE INTO work(user, hour, seconds) VALUES(?, ?, ?)");
  for (const KeptWork& one : work)
    put.bind(1, one.user).bind(2, one.hour).bind(3, one.seconds).run();
}

std::vector<KeptWork> read_work(Database& database) {
  std::vector<KeptWork> work;
  Statement all = database.prepare("SELECT user, hour, seconds FROM work");
  while (all.step())
    if (std::isfinite(all.real(2)) && all.real(2) >= 0)
      work.push_back({all.bytes(0), all.integer(1), all.real(2)});
  return work;
}

}  // namespace metamer::service
