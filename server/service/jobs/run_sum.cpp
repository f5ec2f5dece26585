#include "server/service/jobs/run_sum.h"

#include <algorithm>
#include <string>

#include "server/service/text.h"

namespace metamer::service {

namespace {

/// Bytes of a name, kinds of phases and rays, and machines of a job: with one more an event is a
/// control message still.
constexpr std::size_t most_text = 120;
constexpr int most_kinds = 16;
constexpr int most_machines = 256;

std::string cut_text(const std::string& text) { return shortened(text, most_text); }

/// The message of that name, or a new one; null: there are too many.
template <class Messages, class Get, class Set>
auto* find_or_add(Messages& all, const std::string& key, Get get, Set set) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return (one.*get)() == key; });
  if (found != all.end()) return &*found;
  if (all.size() >= most_kinds) return decltype(&*found){};
  auto* made = all.Add();
  set(*made, key);
  return made;
}

bool is_same(const v1::MachineRecord& a, const v1::MachineRecord& b) {
  return a.name() == b.name() && a.cpu() == b.cpu() && a.gpu() == b.gpu() && a.isa() == b.isa() &&
         a.lanes() == b.lanes();
}

void add_machine(v1::MachineRecord machine, v1::RunRecord& sum) {
  for (std::string* text : {machine.mutable_name(), machine.mutable_cpu(), machine.mutable_gpu(),
                            machine.mutable_isa()})
    *text = cut_text(*text);
  for (v1::MachineRecord& known : *sum.mutable_machine()) {
    if (!is_same(known, machine)) continue;
    known.set_tiles(known.tiles() + machine.tiles());
    known.set_threads(std::max(known.threads(), machine.threads()));
    return;
  }
  if (sum.machine_size() < most_machines) {
    *sum.add_machine() = std::move(machine);
    return;
  }
  v1::MachineRecord& last = *sum.mutable_machine()->rbegin();
  last.set_tiles(last.tiles() + machine.tiles());
}

}  // namespace

void add_run(v1::RunRecord part, std::uint32_t tiles, v1::RunRecord& sum) {
  if (!part.build().empty()) sum.set_build(cut_text(part.build()));
  v1::MachineRecord machine;
  if (part.machine_size() > 0) machine = std::move(*part.mutable_machine(0));
  machine.set_tiles(tiles);
  add_machine(std::move(machine), sum);
  for (const v1::PhaseTime& phase : part.phase()) {
    auto* known =
        find_or_add(*sum.mutable_phase(), cut_text(phase.name()), &v1::PhaseTime::name,
                    [](v1::PhaseTime& to, const std::string& name) { to.set_name(name); });
    if (known == nullptr) break;
    known->set_seconds(known->seconds() + phase.seconds());
    known->set_cpu_seconds(known->cpu_seconds() + phase.cpu_seconds());
  }
  for (const v1::RayCount& rays : part.rays()) {
    auto* known = find_or_add(*sum.mutable_rays(), cut_text(rays.kind()), &v1::RayCount::kind,
                              [](v1::RayCount& to, const std::string& kind) { to.set_kind(kind); });
    if (known == nullptr) break;
    known->set_rays(known->rays() + rays.rays());
    known->set_packets(known->packets() + rays.packets());
  }
  for (const std::string& warm : part.warm()) {
    if (sum.warm_size() >= most_kinds) break;
    if (std::find(sum.warm().begin(), sum.warm().end(), warm) == sum.warm().end())
      sum.add_warm(cut_text(warm));
  }
}

void forget_tiles(v1::RunRecord& sum) {
  sum.clear_rays();
  for (v1::MachineRecord& machine : *sum.mutable_machine()) machine.set_tiles(0);
}

void balance_tiles(std::uint32_t tiles, v1::RunRecord& sum) {
  std::uint64_t counted = 0;
  for (const v1::MachineRecord& machine : sum.machine()) counted += machine.tiles();
  if (counted < tiles) {
    v1::MachineRecord unknown;
    unknown.set_tiles(static_cast<std::uint32_t>(tiles - counted));
    add_machine(std::move(unknown), sum);
  }
  for (v1::MachineRecord& machine : *sum.mutable_machine()) {
    if (counted <= tiles) break;
    const auto less = std::min<std::uint64_t>(machine.tiles(), counted - tiles);
    machine.set_tiles(machine.tiles() - static_cast<std::uint32_t>(less));
    counted -= less;
  }
}

}  // namespace metamer::service
