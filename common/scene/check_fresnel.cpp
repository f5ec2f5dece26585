#include <algorithm>

#include "common/scene/check_spectrum.h"
#include "common/scene/fresnel.h"
#include "common/scene/parts.h"
#include "common/scene/schema.h"
#include "common/spectral/optical_constants.h"

namespace metamer {

namespace {

template <class List>
void check_name(const std::string& name, const List& known, const std::string& what,
                const std::string& field, Findings& findings) {
  std::vector<std::string> names;
  for (const auto& one : known) names.emplace_back(one.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  findings.add(field, unknown_name(quoted(name) + " is not a " + what + " of the library (" +
                                       join(names) + ")",
                                   name, names));
}

void check_sellmeier(const v1::Sellmeier& sellmeier, const std::string& field, Findings& findings) {
  constexpr int max_terms = 6;
  if (sellmeier.b_size() != sellmeier.c_size()) {
    findings.add(field, "sellmeier needs as many b as c (" + std::to_string(sellmeier.b_size()) +
                            " b, " + std::to_string(sellmeier.c_size()) + " c)");
  } else if (sellmeier.b_size() == 0 || sellmeier.b_size() > max_terms) {
    findings.add(field, "sellmeier needs 1 to " + std::to_string(max_terms) + " terms (it has " +
                            std::to_string(sellmeier.b_size()) + ")");
  }
}

void check_dielectric(const v1::Dielectric& dielectric, const std::string& field,
                      Findings& findings) {
  switch (dielectric.index_case()) {
    case v1::Dielectric::kMedium:
      check_name(dielectric.medium(), media(), "medium", field + ".medium", findings);
      break;
    case v1::Dielectric::kN:
      check_spectrum(dielectric.n(), field + ".n", SpectrumRole::index, findings);
      break;
    case v1::Dielectric::kReflectance:
      check_spectrum(dielectric.reflectance(), field + ".reflectance", SpectrumRole::reflectance,
                     findings);
      break;
    case v1::Dielectric::kSellmeier:
      check_sellmeier(dielectric.sellmeier(), field + ".sellmeier", findings);
      break;
    case v1::Dielectric::kCauchy:
      break;
    case v1::Dielectric::INDEX_NOT_SET:
      findings.add(field, "dielectric needs a medium, n, reflectance, sellmeier or cauchy");
      return;
  }
}

void check_conductor(const v1::Conductor& conductor, const std::string& field, Findings& findings) {
  if (!conductor.metal().empty()) {
    check_name(conductor.metal(), metals(), "metal", field + ".metal", findings);
    if (conductor.has_n() || conductor.has_k()) {
      findings.add(field, "conductor takes either a metal or n and k, not both");
    }
    return;
  }
  if (!conductor.has_n() || !conductor.has_k()) {
    findings.add(field, "conductor needs a metal, or n and k");
    return;
  }
  check_spectrum(conductor.n(), field + ".n", SpectrumRole::index, findings);
  check_spectrum(conductor.k(), field + ".k", SpectrumRole::extinction, findings);
}

}  // namespace

void check_fresnel(const v1::Fresnel& fresnel, const std::string& field, Findings& findings) {
  const std::size_t before = findings.size();
  switch (fresnel.fresnel_case()) {
    case v1::Fresnel::kSchlick:
      break;
    case v1::Fresnel::kDielectric:
      check_dielectric(fresnel.dielectric(), field + ".dielectric", findings);
      break;
    case v1::Fresnel::kConductor:
      check_conductor(fresnel.conductor(), field + ".conductor", findings);
      break;
    case v1::Fresnel::FRESNEL_NOT_SET:
      findings.add(field, "fresnel needs schlick, dielectric or conductor");
      break;
  }
  if (findings.size() > before) return;
  if (auto wrong = formula_fault(fresnel.dielectric()); !wrong.empty()) {
    const bool sellmeier = fresnel.dielectric().has_sellmeier();
    findings.add(field + (sellmeier ? ".dielectric.sellmeier" : ".dielectric.cauchy"),
                 std::move(wrong));
  }
}

}  // namespace metamer
