#include "client/cli/commands/compare/compare_json.h"

#include "client/tools/pictures/comparison.h"

namespace metamer::cli {

Json statistics_json(const ErrorStatistics& all, int width) {
  const auto position = [&](std::size_t at) {
    const Pixel pixel = client::pixel_at(at, width);
    return Json{{"x", pixel.x}, {"y", pixel.y}};
  };
  Json json = {{"pixels", all.count}, {"not_finite", all.not_finite}};
  if (all.not_finite > 0) json["first_not_finite"] = position(all.first_not_finite);
  if (all.count == 0) return json;
  json["mean"] = all.mean;
  json["median"] = all.median;
  json["percentile_95"] = all.percentile_95;
  json["percentile_99"] = all.percentile_99;
  json["maximum"] = all.maximum;
  json["at"] = position(all.at);
  return json;
}

}  // namespace metamer::cli
