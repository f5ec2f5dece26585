#include "tests/server/methods/color_error.h"

#include <algorithm>

#include "common/color/lab.h"
#include "common/color/xyz.h"
#include "common/spectral/cie.h"
#include "server/methods/exact.h"
#include "server/plan/plan.h"
#include "tests/server/methods/dense.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

std::string samples(const Spectrum& spectrum) {
  std::string nm, values;
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i) {
    nm += (i ? ", " : "") + std::to_string(spectrum.nm[i]);
    values += (i ? ", " : "") + std::to_string(spectrum.values[i]);
  }
  // The source has straight lines between samples.
  return "{ samples { wavelength: [" + nm + "] value: [" + values + "] } interpolation: LINEAR }";
}

std::string booth(const std::string& illuminant) {
  std::string text =
      "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { standard: "
      "'" +
      illuminant + "' } } object { name: 'o' material: 'TCS01' sphere { radius: 1 } } ";
  for (const std::string& name : cie::test_color_names()) {
    const std::string spectrum = samples(*cie::test_color(name));
    text += "material { name: '" + name + "' mirror: 1 diffuse " + spectrum + " specular " +
            spectrum + " } ";
  }
  return text;
}

/// The reference and the white that it is seen against.
class BandReference {
 public:
  explicit BandReference(const RenderScene& scene)
      : nm_(dense().nm()),
        observer_(observer_weights(cie::observer_1931(), dense())),
        light_(resample(scene.emissions[0], nm_, Outside::zero).values) {
    const double scale = luminance_scale(observer_, light_, 1);
    for (double& value : light_) value *= scale;
    white_ = to_xyz(observer_, light_);
    for (const RenderMaterial& material : scene.materials)
      surfaces_.push_back(resample(scene.properties[material.diffuse], nm_, Outside::hold).values);
  }

  double error(const std::array<float, 3>& seen, const std::vector<std::size_t>& surfaces) const {
    std::vector<double> power = light_;
    for (const std::size_t surface : surfaces)
      for (std::size_t i = 0; i < power.size(); ++i) power[i] *= surfaces_[surface][i];
    return delta_e_00(to_lab({seen[0], seen[1], seen[2]}, white_),
                      to_lab(to_xyz(observer_, power), white_));
  }

 private:
  std::vector<double> nm_;
  ObserverWeights observer_;
  std::vector<double> light_;
  std::vector<std::vector<double>> surfaces_;
  Xyz white_;
};

ColorErrors summed(const std::vector<double>& errors) {
  double sum = 0;
  for (const double error : errors) sum += error;
  return {sum / static_cast<double>(errors.size()),
          *std::max_element(errors.begin(), errors.end())};
}

}  // namespace

MethodErrors errors_of(const std::string& illuminant, const v1::Method& choice) {
  const RenderScene scene = compile_text(booth(illuminant));
  const BandReference reference(scene);
  v1::Settings settings;
  *settings.mutable_method() = choice;
  const auto method = make_method(make_plan(scene, settings, {.threads = 1}), scene);

  std::vector<double> direct, bounce;
  const auto colors = static_cast<std::uint32_t>(scene.materials.size());
  for (std::uint32_t i = 0; i < colors; ++i) {
    Gather gather(1);
    gather.weights(gather.surface(0, i), 0) = {1, 0, 0};
    direct.push_back(reference.error(resolve(*method, gather), {i}));
    for (std::uint32_t mirror = i; mirror < colors; ++mirror) {
      gather.clear();
      const auto mirrored = gather.chain(0, {FactorKind::specular, mirror, 1});
      gather.weights(gather.surface(mirrored, i), 0) = {1, 0, 0};
      bounce.push_back(reference.error(resolve(*method, gather), {i, mirror}));
    }
  }
  return {summed(direct), summed(bounce)};
}

}  // namespace metamer::test
