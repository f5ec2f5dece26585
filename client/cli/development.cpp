#include "client/cli/development.h"

#include "client/tools/scene/words.h"

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
  if (options.linear) {
    development.set_linear(true);
    given.emplace_back("--linear");
  }
  return given;
}

}  // namespace metamer::cli
