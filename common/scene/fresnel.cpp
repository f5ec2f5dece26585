#include "common/scene/fresnel.h"

#include <algorithm>
#include <cmath>

#include "common/models/reference.h"
#include "common/scene/check_spectrum.h"
#include "common/spectral/optical_constants.h"

namespace metamer {

namespace {

std::vector<double> every_nm(double from, double to) {
  std::vector<double> nm;
  for (double at = from; at <= to; ++at) nm.push_back(at);
  return nm;
}

template <class Function>
Spectrum tabulate(std::vector<double> nm, Function function) {
  std::vector<double> values;
  for (const double at : nm) values.push_back(function(at));
  return {std::move(nm), std::move(values)};
}

std::vector<SellmeierTerm> terms_of(const v1::Sellmeier& sellmeier) {
  std::vector<SellmeierTerm> terms;
  for (int i = 0; i < sellmeier.b_size(); ++i) terms.push_back({sellmeier.b(i), sellmeier.c(i)});
  return terms;
}

/// n, sampled finely enough that a line between two samples is n there, too, to 1e-6.
Spectrum index_of(const v1::Dielectric& dielectric) {
  switch (dielectric.index_case()) {
    case v1::Dielectric::kMedium: {
      const auto medium = std::find_if(media().begin(), media().end(), [&](const Medium& one) {
        return one.name == dielectric.medium();
      });
      return tabulate(
          every_nm(std::max(observer_from_nm, medium->from), std::min(observer_to_nm, medium->to)),
          [&](double nm) { return std::sqrt(sellmeier_squared(medium->terms, nm)); });
    }
    case v1::Dielectric::kSellmeier:
      return tabulate(every_nm(observer_from_nm, observer_to_nm),
                      [terms = terms_of(dielectric.sellmeier())](double nm) {
                        return std::sqrt(sellmeier_squared(terms, nm));
                      });
    case v1::Dielectric::kCauchy: {
      const v1::Cauchy& c = dielectric.cauchy();
      return tabulate(every_nm(observer_from_nm, observer_to_nm),
                      [&](double nm) { return cauchy(c.a(), c.b(), c.c(), nm); });
    }
    case v1::Dielectric::kN:
    case v1::Dielectric::kReflectance:
    case v1::Dielectric::INDEX_NOT_SET:
      break;
  }
  return {};
}

/// E[2.2-11] at every nm between the samples: n is no line where the reflectance is one.
Spectrum index_from(const Spectrum& reflectance) {
  std::vector<double> nm = every_nm(std::ceil(reflectance.nm.front()), reflectance.nm.back());
  nm.insert(nm.end(), reflectance.nm.begin(), reflectance.nm.end());
  std::sort(nm.begin(), nm.end());
  nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
  Spectrum n = {nm, resample(reflectance, nm, Outside::hold).values};
  for (double& value : n.values) value = models::index_from_reflectance(value);
  return n;
}

}  // namespace

Result<OpticalConstants> load_fresnel(const v1::Fresnel& fresnel, const std::string& field,
                                      const AssetReader& assets) {
  const v1::Conductor& conductor = fresnel.conductor();
  if (fresnel.has_conductor() && !conductor.metal().empty()) {
    const auto metal = std::find_if(metals().begin(), metals().end(), [&](const Metal& one) {
      return one.name == conductor.metal();
    });
    return OpticalConstants{metal->n, metal->k};
  }
  if (fresnel.has_conductor()) {
    auto n = load_spectrum(conductor.n(), field + ".conductor.n", SpectrumRole::index, assets);
    if (!n) return tl::unexpected(std::move(n.error()));
    auto k = load_spectrum(conductor.k(), field + ".conductor.k", SpectrumRole::extinction, assets);
    if (!k) return tl::unexpected(std::move(k.error()));
    return OpticalConstants{*std::move(n), *std::move(k)};
  }

  const v1::Dielectric& dielectric = fresnel.dielectric();
  if (dielectric.has_n() || dielectric.has_reflectance()) {
    const bool direct = dielectric.has_n();
    auto read = load_spectrum(direct ? dielectric.n() : dielectric.reflectance(),
                              field + ".dielectric" + (direct ? ".n" : ".reflectance"),
                              direct ? SpectrumRole::index : SpectrumRole::reflectance, assets);
    if (!read) return tl::unexpected(std::move(read.error()));
    return OpticalConstants{direct ? *std::move(read) : index_from(*read), {}};
  }
  return OpticalConstants{index_of(dielectric), {}};
}

std::string formula_fault(const v1::Dielectric& dielectric) {
  if (!dielectric.has_sellmeier() && !dielectric.has_cauchy()) return {};
  const Spectrum n = index_of(dielectric);
  for (std::size_t i = 0; i < n.nm.size(); ++i) {
    // Also when it is not a number: a root of less than 0.
    if (value_fault(n.values[i], SpectrumRole::index).empty()) continue;
    if (std::isnan(n.values[i])) return "n² is negative at " + number_text(n.nm[i]) + " nm";
    return "n must lie in 0.01..100 (it is " + number_text(n.values[i]) + " at " +
           number_text(n.nm[i]) + " nm)";
  }
  return {};
}

}  // namespace metamer
