#include "server/plan/plan_method.h"

#include <algorithm>

#include "common/scene/settings.h"
#include "server/methods/exact.h"
#include "server/methods/fitted.h"
#include "server/methods/linear.h"
#include "server/methods/method.h"
#include "server/methods/prefilter.h"

namespace metamer {
namespace {

/// Says where the scene's spectra gave fewer bands than were asked for.
void plan_found(std::size_t found, std::size_t asked, const char* field, const std::string& verb,
                const std::string& noun, v1::Plan& plan) {
  plan.set_bands(static_cast<std::uint32_t>(found));
  if (found == asked) return;
  v1::Notice* notice = plan.add_notice();
  notice->set_field(field);
  notice->set_message("the scene's spectra " + verb + " no more than " + std::to_string(found) +
                      " " + noun + (found == 1 ? "" : "s"));
}

/// How good the basis is.
void plan_basis(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan) {
  const v1::Linear& linear = settings.method().linear();
  const LinearBasis basis = scene_basis(linear, to_observer(settings.observer()), scene);
  plan.set_condition(basis.condition);
  plan.set_residual(basis.residual);
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(16, basis.singular_values.size()); ++i)
    plan.add_singular_value(basis.singular_values[i]);
  plan_found(static_cast<std::size_t>(basis.functions.cols()), linear.bases(),
             "settings.method.linear.bases", "span", "function", plan);
}

/// The wavelengths that were chosen are part of the plan.
void plan_fit(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan) {
  const v1::Point& point = settings.method().point();
  const auto nm = fitted_wavelengths(scene, to_observer(settings.observer()), point.fitted());
  plan.mutable_wavelength()->Assign(nm.begin(), nm.end());
  plan.set_from(nm.front());
  plan.set_to(nm.back());
  plan_found(nm.size(), point.fitted(), "settings.method.point.fitted", "need", "wavelength", plan);
}

}  // namespace

void plan_method(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan) {
  const v1::Method& method = settings.method();
  const Wavelengths wavelengths = method_wavelengths(method);
  plan.set_from(wavelengths.nm().front());
  plan.set_to(wavelengths.nm().back());
  plan.set_bands(static_cast<std::uint32_t>(method_bands(method)));

  if (method.has_exact()) plan.set_signatures(direct_signatures(scene));
  if (method.has_linear()) plan_basis(scene, settings, plan);
  if (method.has_point() && method.point().has_fitted()) plan_fit(scene, settings, plan);
  if (method.has_prefilter()) notice_prefilter(scene, to_observer(settings.observer()), plan);
}

}  // namespace metamer
