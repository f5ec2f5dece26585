#include "common/scene/check_spectrum.h"
#include "common/scene/parts.h"

namespace metamer {

void check_material(const v1::Material& material, const std::string& field, Findings& findings) {
  if (!check_values(material, field, findings)) return;

  if (material.has_diffuse()) {
    check_spectrum(material.diffuse(), field + ".diffuse", SpectrumRole::property, findings);
  }
  if (material.has_specular()) {
    check_spectrum(material.specular(), field + ".specular", SpectrumRole::property, findings);
  }
  if (material.has_diffuseness()) {
    check_range(material.diffuseness(), 0, 1, field + ".diffuseness", findings);
  }
  if (material.has_specularness()) {
    check_range(material.specularness(), 0, 1, field + ".specularness", findings);
  }
  check_range(material.mirror(), 0, 1, field + ".mirror", findings);
  check_reflection(material, field, findings);
  if (material.has_texture()) check_texture(material.texture(), field + ".texture", findings);
  if (material.has_normal_map())
    check_map(material.normal_map(), MapUse::normals, field + ".normal_map", findings);
  if (material.has_bump_map())
    check_map(material.bump_map(), MapUse::heights, field + ".bump_map", findings);
  if (material.has_alpha()) check_map(material.alpha(), MapUse::alpha, field + ".alpha", findings);
  if (material.has_alpha() && material.has_transmission())
    findings.add(field + ".alpha",
                 "what lets light through encloses a volume: its surface has no holes");
  if (material.texture().use() == v1::Texture::RGB && material.has_diffuse())
    findings.add(field + ".diffuse", "an RGB texture leaves nothing of `diffuse` to be seen");
  if (material.texture().use() == v1::Texture::RGB && material.has_fluorescence())
    findings.add(field + ".fluorescence",
                 "an RGB texture leaves nothing of the surface that fluoresces to be seen");
  if (material.has_fluorescence())
    check_fluorescence(material.fluorescence(), field + ".fluorescence", findings);
  if (material.has_fresnel()) check_fresnel(material.fresnel(), field + ".fresnel", findings);
  if (material.has_transmission()) check_transmission(material, field + ".transmission", findings);
}

}  // namespace metamer
