#include "common/color/metamerism.h"

namespace metamer {

Result<std::vector<Mismatch>> metamerism(const Spectrum& one, const Spectrum& other,
                                         const std::vector<NamedSpectrum>& lights,
                                         const Observer& observer) {
  const std::vector<double> nm = cell_edges({&one, &other}), perfect(nm.size(), 1.0);
  const std::vector<double> a = resample(one, nm, Outside::hold).values;
  const std::vector<double> b = resample(other, nm, Outside::hold).values;

  std::vector<Mismatch> result;
  for (const NamedSpectrum& light : lights) {
    const ObserverWeights lit = under_light(observer, light.spectrum, nm);
    const Xyz white = to_xyz(lit, perfect), first = to_xyz(lit, a), second = to_xyz(lit, b);
    for (const double value : white)
      if (!(value > 0)) return problem("the light " + quoted(light.name) + " has no white to see");
    const Lab lab = to_lab(first, white), other_lab = to_lab(second, white);
    result.push_back({.light = light.name,
                      .one = first,
                      .other = second,
                      .white = white,
                      .de00 = delta_e_00(lab, other_lab),
                      .deab = delta_e_ab(lab, other_lab),
                      .deuv = delta_e_uv(to_luv(first, white), to_luv(second, white))});
  }
  return result;
}

MetamerismIndex metamerism_index(const Mismatch& reference, const Mismatch& test) {
  Xyz corrected = test.other;
  for (std::size_t c = 0; c < corrected.size(); ++c)
    if (reference.other[c] > 0) corrected[c] *= reference.one[c] / reference.other[c];
  const Lab one = to_lab(test.one, test.white), other = to_lab(corrected, test.white);
  return {.de00 = delta_e_00(one, other), .deab = delta_e_ab(one, other)};
}

std::vector<NamedSpectrum> cie_lights() {
  std::vector<NamedSpectrum> lights;
  for (const std::string& name : cie::illuminant_names())
    lights.push_back({.name = name, .spectrum = *cie::illuminant(name)});
  return lights;
}

}  // namespace metamer
