#pragma once

#include <array>
#include <functional>
#include <iterator>

namespace metamer::gl {

/// The passes of a renderer.
enum class Pass : unsigned char { places, visibility, shading, color };
inline constexpr Pass all_passes[] = {Pass::places, Pass::visibility, Pass::shading, Pass::color};
const char* name_of(Pass pass);

/// How long the passes take: by the GPU's own timers where they can be believed, else by the clock
/// around a pass that is waited for. Needs a current Context, also to be destroyed.
class PassClock {
 public:
  explicit PassClock(bool timers);
  PassClock(const PassClock&) = delete;
  PassClock& operator=(const PassClock&) = delete;
  ~PassClock();

  /// Runs GL calls and adds their time to a pass.
  void run(Pass pass, const std::function<void()>& calls);
  /// Since its beginning.
  double seconds(Pass pass) const { return seconds_[static_cast<std::size_t>(pass)]; }

 private:
  unsigned query_ = 0;  ///< 0: by the clock.
  std::array<double, std::size(all_passes)> seconds_{};
};

}  // namespace metamer::gl
