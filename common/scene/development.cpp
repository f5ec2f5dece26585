#include "common/scene/development.h"

#include <cmath>

namespace metamer {
namespace {

using Numbers = google::protobuf::RepeatedField<double>;

Result<RgbSpace> own_space(const v1::Primaries& message) {
  Primaries primaries{};
  const auto read = [](const Numbers& numbers, const std::string& name, Chromaticity& to) {
    if (numbers.size() != 2)
      return Result<void>(tl::unexpected<Problem>(
          {.field = "primaries." + name,
           .file = {},
           .message = name + " must be x and y (it has " + std::to_string(numbers.size()) +
                      (numbers.size() == 1 ? " number)" : " numbers)")}));
    to = {numbers[0], numbers[1]};
    return Result<void>();
  };
  Result<void> done = read(message.red(), "red", primaries.red);
  if (done) done = read(message.green(), "green", primaries.green);
  if (done) done = read(message.blue(), "blue", primaries.blue);
  if (done) done = read(message.white(), "white", primaries.white);
  if (!done) return tl::unexpected(std::move(done.error()));

  const double gamma = message.has_gamma() ? message.gamma() : 1;
  return make_rgb_space("primaries", "scene's own RGB", primaries, {.gamma = gamma})
      .map_error([](Problem&& wrong) {
        wrong.field = "primaries";
        return std::move(wrong);
      });
}

/// What X Y Z are multiplied by.
double brightness(const v1::Development& development) {
  if (development.has_exposure()) return std::exp2(development.exposure());
  return development.has_white_luminance() ? 1 / development.white_luminance() : 1;
}

/// The white of the dominant light becomes that of the space.
Result<Matrix3> from_source_white(const v1::Plan& plan, Adaptation adaptation,
                                  const RgbSpace& space) {
  if (plan.source_white_size() != 3) return problem("the dominant light has no white");
  return adaptation_matrix(adaptation,
                           {plan.source_white(0), plan.source_white(1), plan.source_white(2)},
                           white_xyz(space.primaries.white));
}

}  // namespace

Adaptation to_adaptation(v1::Adaptation adaptation) {
  switch (adaptation) {
    case v1::NO_ADAPTATION:
      return Adaptation::none;
    case v1::VON_KRIES:
      return Adaptation::von_kries;
    case v1::BRADFORD:
      return Adaptation::bradford;
    case v1::SHARP:
      return Adaptation::sharp;
    case v1::CMCCAT2000:
      return Adaptation::cmccat2000;
    // protobuf's own two, which no message can hold.
    case v1::Adaptation_INT_MIN_SENTINEL_DO_NOT_USE_:
    case v1::Adaptation_INT_MAX_SENTINEL_DO_NOT_USE_:
      break;
  }
  return Adaptation::none;
}

StandardSpace to_standard_space(v1::RgbSpace space) {
  switch (space) {
    case v1::SRGB:
      return StandardSpace::srgb;
    case v1::DISPLAY_P3:
      return StandardSpace::display_p3;
    case v1::ADOBE_RGB:
      return StandardSpace::adobe_rgb;
    case v1::PROPHOTO:
      return StandardSpace::prophoto;
    case v1::REC_2020:
      return StandardSpace::rec_2020;
    case v1::CIE_RGB:
      return StandardSpace::cie_rgb;
    case v1::RgbSpace_INT_MIN_SENTINEL_DO_NOT_USE_:
    case v1::RgbSpace_INT_MAX_SENTINEL_DO_NOT_USE_:
      break;
  }
  return StandardSpace::srgb;
}

Result<RgbSpace> to_rgb_space(const v1::Development& development) {
  if (development.has_primaries()) return own_space(development.primaries());
  return rgb_space(to_standard_space(development.rgb_space()));
}

namespace {

Result<PlannedDevelopment> adapted_development(const v1::Plan& plan) {
  Result<RgbSpace> space = to_rgb_space(plan.development());
  if (!space) return tl::unexpected(std::move(space.error()));
  PlannedDevelopment result{
      .space = std::move(*space), .adaptation = identity3, .unadapted = {}, .shown_white = {}};
  if (plan.development().has_adaptation()) {
    const Adaptation asked = to_adaptation(plan.development().adaptation());
    if (asked == Adaptation::none) {
      if (white_for_d65(result.space) != identity3)
        result.shown_white = "not adapted: a viewer that goes by the white of " +
                             result.space.name + " shows D65's grey tinted";
      return result;
    }
    const auto matrix = from_source_white(plan, asked, result.space);
    if (matrix) {
      result.adaptation = *matrix;
      return result;
    }
    result.unadapted = matrix.error().message;
  }
  const auto matrix = white_for_d65(result.space);
  if (!matrix || *matrix == identity3) return result;
  result.adaptation = *matrix;
  result.shown_white = "D65 becomes the white of " + result.space.name +
                       " (bradford), so that the picture looks as in sRGB; adaptation none "
                       "leaves X Y Z as they are";
  return result;
}

}  // namespace

Result<PlannedDevelopment> planned_development(const v1::Plan& plan) {
  auto planned = adapted_development(plan);
  const double factor = brightness(plan.development());
  if (planned && factor != 1)
    for (auto& row : planned->adaptation)
      for (double& value : row) value *= factor;
  return planned;
}

}  // namespace metamer
