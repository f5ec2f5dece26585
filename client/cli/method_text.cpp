#include "client/cli/method_text.h"

#include <cstdio>

namespace metamer::cli {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string point_text(const v1::Point& point) {
  if (point.fitted() > 0) return "point fitted " + std::to_string(point.fitted());
  if (!point.wavelengths().empty())
    return "point at " + std::to_string(point.wavelengths_size()) + " listed";
  return "point " + number(point.from()) + ":" + number(point.to()) + ":" + number(point.step());
}

std::string linear_text(const v1::Linear& linear) {
  return "linear " + std::to_string(linear.bases()) +
         (linear.weighting() == v1::Linear::OBSERVER ? " observer" : "") +
         (linear.bounce() ? " bounce" : "");
}

std::string auto_text(const v1::Auto& goal) {
  return goal.has_deadline() ? "auto, deadline " + number(goal.deadline()) + " s"
                             : "auto, tolerance " + number(goal.tolerance());
}

}  // namespace

std::string method_text(const v1::Method& method) {
  switch (method.method_case()) {
    case v1::Method::kPoint:
      return point_text(method.point());
    case v1::Method::kLinear:
      return linear_text(method.linear());
    case v1::Method::kAuto:
      return auto_text(method.auto_());
    case v1::Method::kRgb:
      return "rgb";
    case v1::Method::kExact:
      return "exact";
    case v1::Method::kPrefilter:
      return "prefilter";
    case v1::Method::METHOD_NOT_SET:
      break;
  }
  return "";
}

}  // namespace metamer::cli
