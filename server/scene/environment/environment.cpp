#include "server/scene/environment/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/color/rgb_reflectance.h"
#include "common/color/sunlight.h"
#include "common/color/xyz.h"
#include "common/scene/findings.h"
#include "server/scene/environment/daylight_sky.h"

namespace metamer {
namespace {

constexpr std::array<Rgb, 3> primaries = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array part_names = {" (red)", " (green)", " (blue)"};

/// A light behind a filter. The product of two lines is none: it is taken at every nm as well.
Spectrum filtered(const Spectrum& emission, const Spectrum& filter) {
  std::vector<double> nm = emission.nm;
  for (double at = std::ceil(emission.nm.front()); at < emission.nm.back(); ++at) nm.push_back(at);
  for (const double at : filter.nm)
    if (at > emission.nm.front() && at < emission.nm.back()) nm.push_back(at);
  std::sort(nm.begin(), nm.end());
  nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
  std::vector<double> values = resample(emission, nm, Outside::zero).values;
  const std::vector<double> share = resample(filter, nm, Outside::hold).values;
  for (std::size_t i = 0; i < nm.size(); ++i) values[i] *= share[i];
  return {std::move(nm), std::move(values)};
}

/// 1 at a band, 0 at the next ones; beyond the ends as wide as before them.
Spectrum hat(const std::vector<double>& nm, std::size_t band) {
  const double at = nm[band], next = band + 1 < nm.size() ? nm[band + 1] : 0;
  const double before = band > 0   ? nm[band - 1]
                        : next > 0 ? std::max(at / 2, 2 * at - next)
                                   : 0.999 * at;
  return {{before, at, next > 0 ? next : 2 * at - before}, {0, 1, 0}};
}

/// What a picture's values weigh.
struct Parts {
  std::vector<Spectrum> spectra;
  std::vector<std::string> names;
};

/// Of a file's picture, by the light's own spectrum.
Parts parts_of(const SkyPicture& picture, const Spectrum& own) {
  Parts parts;
  for (std::size_t i = 0; i < picture.parts(); ++i) {
    const bool is_rgb = picture.nm.empty();
    parts.spectra.push_back(
        filtered(own, is_rgb ? reflectance_of_rgb(primaries[i]) : hat(picture.nm, i)));
    parts.names.push_back(is_rgb ? part_names[i] : " (" + number_text(picture.nm[i]) + " nm)");
  }
  return parts;
}

/// The shares of the parts in their luminance.
std::vector<double> shares_of(const std::vector<Spectrum>& parts, const Observer& observer) {
  std::vector<double> y;
  double sum = 0;
  for (const Spectrum& part : parts) sum += y.emplace_back(emission_xyz(part, observer)[1]);
  for (double& share : y)  // those of a light that is not seen are alike
    share = sum > 0 ? share / sum : 1 / static_cast<double>(parts.size());
  return y;
}

/// Y of a perfect white facing +y: 1/π ∫ L cos θ dω over the upper half.
double ground_luminance(const SkyPicture& picture, const std::vector<double>& shares) {
  double sum = 0;
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    const auto cosine = [&](double row) {
      return std::max(0.0, std::cos(row * std::numbers::pi / picture.height));
    };
    const double above = cosine(y), below = cosine(y + 1.0);
    double row = 0;
    for (std::uint32_t x = 0; x < picture.width; ++x)
      for (std::size_t i = 0; i < shares.size(); ++i)
        row += shares[i] * double{picture.at(x, y)[i]};
    // ∫ cos θ dω of one pixel is Δφ (cos²θ₀ − cos²θ₁) / 2, and Δφ = 2π / width.
    sum += row * (above * above - below * below) / picture.width;
  }
  return sum;
}

/// Error: it can't be scaled so that the ground has Y = 1.
Result<void> check_ground(const SkyPicture& picture, double ground) {
  constexpr double most = 1e30;
  const float brightest = *std::max_element(picture.values.begin(), picture.values.end());
  if (!(brightest <= most * ground))
    return problem(
        "nothing shines from above the horizon, where its luminance is measured: a perfect white "
        "on the ground would be black");
  return {};
}

/// The light of the whole, of which a picture's lights are parts.
RenderLight whole_light(const v1::Light& light, const std::string& field, std::uint32_t emission) {
  return {.name = light.name(),
          .field = field,
          .source = RenderLight::Source::environment,
          .light = {},
          .parameters = {},
          .reference_distance = 0,
          .luminance = light.has_luminance() ? light.luminance() : 1,
          .solid_angle = std::numbers::pi,
          .emission = emission,
          .own_emission = emission,
          .visible = !light.has_visible() || light.visible()};
}

/// Splits the light, and measures what the whole gives.
Result<void> add_picture(std::shared_ptr<const SkyPicture> picture, Parts parts,
                         const RenderLight& whole, RenderScene& scene) {
  const std::vector<double> shares = shares_of(parts.spectra, scene.observer);
  const double ground = ground_luminance(*picture, shares);
  if (auto good = check_ground(*picture, ground); !good) return good;
  std::vector<double> luminances;
  for (std::size_t i = 0; i < parts.spectra.size(); ++i) {
    RenderLight& part = scene.lights.emplace_back(whole);
    part.name += parts.names[i];
    luminances.push_back(part.luminance *= shares[i]);
    part.emission = static_cast<std::uint32_t>(scene.emissions.size());
    scene.emissions.push_back(std::move(parts.spectra[i]));
    scene.emission_fields.push_back(scene.emission_fields[whole.emission]);
  }
  scene.environment->tables =
      std::make_shared<const SkyTables>(sky_tables(*picture, std::move(luminances), ground));
  scene.environment->picture = std::move(picture);
  return {};
}

/// A sky by day, whose spectra are its own.
Result<void> add_daylight(const v1::Light::Sky& sky, const std::string& field, RenderLight whole,
                          RenderScene& scene) {
  const DaylightSky model(sky.has_turbidity() ? sky.turbidity() : usual_turbidity,
                          sky.has_elevation() ? sky.elevation() : usual_elevation);
  PaintedSky painted = paint(model);
  scene.environment->rotation += sky.azimuth() * std::numbers::pi / 180;
  whole.emission = whole.own_emission = static_cast<std::uint32_t>(scene.emissions.size());
  scene.emissions.push_back(std::move(painted.whole));
  scene.emission_fields.push_back(field);
  return add_picture(std::make_shared<const SkyPicture>(std::move(painted.picture)),
                     {std::move(painted.parts), {" (1)", " (2)", " (3)"}}, whole, scene);
}

}  // namespace

Result<void> add_environment(const v1::Light& light, const std::string& field,
                             std::uint32_t emission, const SkyImport& skies, RenderScene& scene) {
  const RenderLight whole = whole_light(light, field, emission);
  scene.environment =
      RenderEnvironment{.field = field,
                        .first_light = static_cast<std::uint32_t>(scene.lights.size()),
                        .picture = {},
                        .tables = {},
                        .rotation = light.environment().rotation() * std::numbers::pi / 180,
                        .visible = whole.visible};
  if (light.environment().has_sky())
    return add_daylight(light.environment().sky(), field + ".environment.sky", whole, scene);
  const std::string& file = light.environment().file();
  if (file.empty()) {
    scene.lights.push_back(whole);
    return {};
  }
  const std::string file_field = field + ".environment.file";
  return skies(file)
      .and_then([&](const std::shared_ptr<const ReadSky>& read) {
        for (const std::string& note : read->notes) scene.notices.push_back({file_field, note});
        return add_picture({read, &read->picture},
                           parts_of(read->picture, scene.emissions[emission]), whole, scene);
      })
      .map_error([&](Problem&& wrong) {
        wrong.field = file_field;
        return std::move(wrong);
      });
}

}  // namespace metamer
