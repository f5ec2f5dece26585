#include "server/render/factor_size.h"

#include <algorithm>
#include <limits>

#include "server/film/factor_sink.h"
#include "server/render/pilot.h"

namespace metamer {
namespace {

struct NoSink : PixelSink {
  void take(std::uint32_t, std::uint32_t, const Gather&) override {}
};

}  // namespace

std::uint32_t FactorSize::tile_size(const v1::Plan& plan, double most) const {
  for (const std::uint32_t side : {plan.tile_size(), 8U})
    if (pixel * side * side <= most) return side;
  return 0;
}

FactorSize factor_size(const Probe& probe, const v1::Plan& plan, const std::atomic<bool>& stopped,
                       std::atomic<std::uint64_t>& work) {
  const TracedPixels traced = probe.trace(plan, {0, pilot_count(plan)}, stopped, work);
  NoSink none;
  FactorSink sink(none, plan.spp());
  FactorSize size;
  double sum = 0;
  for (const Gather& gather : traced.gathers) {
    sink.begin({0, 0, 1, 1});
    sink.take(0, 0, gather);
    const double bytes = static_cast<double>(sink.finish().ByteSizeLong());
    size.pixel =
        sink.overflowed() ? std::numeric_limits<double>::infinity() : std::max(size.pixel, bytes);
    if (sink.overflowed()) break;
    sum += bytes;
  }
  if (!traced.gathers.empty()) size.mean = sum / static_cast<double>(traced.gathers.size());
  return size;
}

}  // namespace metamer
