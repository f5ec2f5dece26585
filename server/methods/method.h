#pragma once

#include <array>
#include <memory>
#include <vector>

#include "common/scene/features.h"
#include "common/spectral/wavelengths.h"
#include "metamer/v1/plan.pb.h"
#include "server/methods/direct_tables.h"
#include "server/scene/render_scene.h"
#include "server/transport/gather.h"

namespace metamer {

/// How colour is carried: turns what a pixel gathered into XYZ. Its tables are made once from a
/// scene and a plan; after that it is immutable and serves all threads.
class Method {
 public:
  virtual ~Method() = default;

  /// A thread's own working memory, for this method alone.
  struct Scratch {
    virtual ~Scratch() = default;
  };
  virtual std::unique_ptr<Scratch> make_scratch() const = 0;

  /// The light of one pixel, X Y Z, `scale` times the sums of `gather` (1 / samples).
  virtual std::array<float, 3> resolve(const Gather& gather, float scale,
                                       Scratch& scratch) const = 0;

  /// The same for paths without mirrors, as arrays.
  virtual DirectTables direct_tables() const = 0;
};

std::unique_ptr<Method> make_method(const v1::Plan& plan, const RenderScene& scene);

/// What a method has of what a scene may need; of none, what one that is chosen later has.
Features method_features(const v1::Method& method);

/// The wavelengths at which a method reads the spectra, its defaults filled in; where it is made
/// for the scene, those at which it learns.
Wavelengths method_wavelengths(const v1::Method& method);

/// The values that its carrier holds, at the most.
std::size_t method_bands(const v1::Method& method);

/// Adds a notice for each light of which the observer sees nothing at these wavelengths: it has
/// power somewhere, and the picture would be dark without a word.
void notice_dark_lights(const RenderScene& scene, const v1::Settings& settings,
                        const Wavelengths& wavelengths, v1::Plan& plan);

}  // namespace metamer
