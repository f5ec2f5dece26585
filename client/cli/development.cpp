#include "client/cli/development.h"

#include <cmath>

#include "client/tools/scene/words.h"
#include "common/scene/limits.h"

namespace metamer::cli {

Result<std::vector<std::string>> apply(const DevelopmentOptions& options,
                                       v1::Development& development) {
  std::vector<std::string> given;
  if (options.adaptation) {
    const auto adaptation = client::adaptation_named(*options.adaptation);
    if (!adaptation) return problem("--adapt: " + adaptation.error().message);
    development.set_adaptation(*adaptation);
    given.emplace_back("--adapt");
  }
  if (options.rgb) {
    const auto space = client::rgb_space_named(*options.rgb);
    if (!space) return problem("--rgb: " + space.error().message);
    development.set_rgb_space(*space);
    given.emplace_back("--rgb");
  }
  if (options.exposure) {
    if (!(std::abs(*options.exposure) <= limits::max_exposure))
      return problem("--exposure: it must lie in -30..30");
    development.set_exposure(*options.exposure);
    given.emplace_back("--exposure");
  }
  if (options.linear) {
    development.set_linear(true);
    given.emplace_back("--linear");
  }
  return given;
}

}  // namespace metamer::cli
