#include <algorithm>

#include "common/scene/check_method.h"
#include "common/scene/development.h"
#include "common/scene/limits.h"
#include "common/scene/methods.h"
#include "common/scene/parts.h"
#include "common/scene/settings.h"

namespace metamer {

namespace {

void check_picture(const v1::Settings& full, const std::string& field, Findings& findings) {
  check_range(full.width(), 1, limits::max_side, field + ".width", findings);
  check_range(full.height(), 1, limits::max_side, field + ".height", findings);
}

/// What there is instead of a method, by either of its names.
void check_goals(const v1::Settings& settings, const v1::Settings& full, const std::string& field,
                 Findings& findings) {
  const bool older = settings.method().has_auto_();
  if (older && settings.has_goal())
    return findings.add(field + ".method.auto",
                        "auto is the older way to write goal, which is given too: leave it out");
  if (!older && !settings.has_goal()) return;

  const std::string name = older ? "method.auto" : "goal";
  if (const MethodEntry* method = method_entry(settings.method()))
    return findings.add(field + "." + name,
                        "settings take a method or a goal, not both: leave out " +
                            std::string(method->word) + " and the server chooses, or leave out " +
                            name);
  check_goal(full.goal(), field + "." + name, findings);
}

void check_observer(const v1::Settings& settings, const std::string& field, Findings& findings) {
  if (!settings.observer_file().empty() && settings.observer() != v1::CIE_1931_2DEG)
    findings.add(field + ".observer_file",
                 "an observer_file takes the place of observer, which is given too: leave out one");
}

}  // namespace

// Its other values are those of enums, which check_values knows.
void check_development(const v1::Development& development, const std::string& field,
                       Findings& findings) {
  const Result<RgbSpace> space = to_rgb_space(development);
  if (!space) findings.add(field + "." + space.error().field, space.error().message);
  if (development.has_exposure())
    check_range(development.exposure(), -limits::max_exposure, limits::max_exposure,
                field + ".exposure", findings);
  if (development.has_white_luminance())
    check_range(development.white_luminance(), limits::min_luminance, limits::max_luminance,
                field + ".white_luminance", findings);
}

void check_settings(const v1::Settings& settings, const std::string& field, Findings& findings) {
  if (!check_values(settings, field, findings)) return;

  const v1::Settings full = with_defaults(settings);
  check_picture(full, field, findings);
  check_observer(full, field, findings);
  check_goals(settings, full, field, findings);
  if (const MethodEntry* method = method_entry(full.method()); method && method->check)
    method->check(full.method(), field + ".method." + method->word, findings);
  check_development(full.development(), field + ".development", findings);
  check_range(full.spp(), 1, limits::max_spp, field + ".spp", findings);
  check_range(full.light_samples(), 1, limits::max_light_samples, field + ".light_samples",
              findings);
  check_range(full.bounces(), 0, limits::max_bounces, field + ".bounces", findings);
  check_range(full.bounce_samples(), 1, limits::max_bounce_samples, field + ".bounce_samples",
              findings);
  if (full.bounces() > 0 && full.spp() <= limits::max_spp &&
      full.bounce_samples() <= limits::max_bounce_samples &&
      full.spp() * full.bounce_samples() > limits::max_paths)
    findings.add(field + ".bounce_samples",
                 "spp × bounce_samples must be at most " + std::to_string(limits::max_paths) +
                     " (it is " + std::to_string(full.spp() * full.bounce_samples()) + ")",
                 full.bounce_samples(), limits::max_paths / full.spp());
  check_range(full.depth(), 0, limits::max_depth, field + ".depth", findings);
  check_range(full.cutoff(), limits::min_cutoff, 1, field + ".cutoff", findings);
  check_range(full.threads(), 0, limits::max_threads, field + ".threads", findings);
  if (full.tile_size() % 8 != 0 || full.tile_size() < 8 || full.tile_size() > limits::max_tile) {
    const std::uint32_t within = std::clamp<std::uint32_t>(full.tile_size(), 8, limits::max_tile);
    findings.add(field + ".tile_size",
                 "tile_size must be a multiple of 8 in 8.." + std::to_string(limits::max_tile) +
                     " (it is " + std::to_string(full.tile_size()) + ")",
                 full.tile_size(), (within + 4) / 8 * 8);
  }
}

}  // namespace metamer
