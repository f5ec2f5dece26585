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

  /// What making the tables costs, and resolving a pixel: in nanoseconds of a core of 3 GHz with
  /// lanes of eight, counted and not measured, so that whoever compares methods by it comes to the
  /// same on every machine at any load.
  virtual double preparation_cost() const = 0;
  virtual double resolve_cost(const Gather& gather) const = 0;
};

/// What comes to every method: scalars, and factors of each kind, for which FactorRows has rows.
inline constexpr Features carried_features = Features::all().without({Feature::multi_pass});

/// A method's arithmetic. What clients know of it too is its row in common/scene/methods.h.
struct MethodArithmetic {
  const char* word;  ///< Its member of v1::Method.method.
  std::unique_ptr<Method> (*make)(const v1::Plan&, const RenderScene&);
  /// Adds to a plan what the scene makes of it: bands where they are not three, what it found, and
  /// notices. Null: nothing.
  void (*plan)(const RenderScene&, const v1::Settings&, v1::Plan&) = nullptr;
  Wavelengths (*wavelengths)(const v1::Method&) = nullptr;  ///< Null: every nm from 360 to 830.
  Features features = carried_features;
};

/// Every method: a test holds it against the schema and against method_entries().
const std::vector<MethodArithmetic>& method_arithmetic();

std::unique_ptr<Method> make_method(const v1::Plan& plan, const RenderScene& scene);

/// What a method has of what a scene may need; of none, what one that is chosen later has.
Features method_features(const v1::Method& method);

/// The wavelengths at which a method reads the spectra, its defaults filled in; where it is made
/// for the scene, those at which it learns.
Wavelengths method_wavelengths(const v1::Method& method);

/// Fills in what the settings' method needs for this scene: wavelengths, bands, and of a method
/// that is made for the scene, what was found; with notices where that is less than was asked for.
void plan_method(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan);

}  // namespace metamer
