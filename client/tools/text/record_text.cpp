#include "client/tools/text/record_text.h"

#include "client/tools/text/formatted.h"
#include "client/tools/text/job_text.h"
#include "common/printable.h"

namespace metamer::client {
namespace {

std::string machine_line(const v1::MachineRecord& machine) {
  std::string text =
      "machine  " + (machine.name().empty() ? std::string("unknown") : printable(machine.name()));
  for (const std::string* part : {&machine.cpu(), &machine.gpu(), &machine.isa()})
    if (!part->empty()) text += ", " + printable(*part);
  if (machine.lanes() > 0) text += ", packets of " + std::to_string(machine.lanes());
  if (machine.threads() > 0) text += ", " + counted(machine.threads(), "thread", "threads");
  return text + ", " + counted(machine.tiles(), "tile", "tiles");
}

std::string rays_line(const v1::RayCount& rays, std::uint32_t lanes) {
  std::string text = formatted("rays     %-12s  %14llu", printable(rays.kind()).c_str(),
                               static_cast<unsigned long long>(rays.rays()));
  if (rays.packets() == 0) return text;
  text += formatted(" in %llu packets", static_cast<unsigned long long>(rays.packets()));
  if (lanes == 0) return text;
  const double places = static_cast<double>(rays.packets()) * lanes;
  return text +
         formatted(", %.0f %% of their lanes", 100 * static_cast<double>(rays.rays()) / places);
}

}  // namespace

std::vector<std::string> record_lines(const v1::RunRecord& record) {
  std::vector<std::string> lines;
  lines.push_back("build    " + printable(record.build()) + ", server " +
                  printable(record.server_build()));
  for (const v1::MachineRecord& machine : record.machine()) lines.push_back(machine_line(machine));
  for (const v1::PhaseTime& phase : record.phase())
    lines.push_back(formatted("phase    %-12s  %9.4f s  %9.4f CPU s",
                              printable(phase.name()).c_str(), phase.seconds(),
                              phase.cpu_seconds()));
  std::string warm;
  for (const std::string& one : record.warm()) warm += (warm.empty() ? "" : ", ") + printable(one);
  lines.push_back("warm     " + (warm.empty() ? "nothing" : warm));
  // Of machines of several lane counts nobody knows which ray was where.
  std::uint32_t lanes = record.machine_size() > 0 ? record.machine(0).lanes() : 0;
  for (const v1::MachineRecord& machine : record.machine())
    if (machine.lanes() != lanes) lanes = 0;
  for (const v1::RayCount& rays : record.rays()) lines.push_back(rays_line(rays, lanes));
  return lines;
}

}  // namespace metamer::client
