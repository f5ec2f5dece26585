#include "common/scene/check_spectrum.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"
#include "common/scene/parts.h"

namespace metamer {
namespace {

/// What a texture and a map have in common: a picture, and where it lies. False: there is none.
template <class Picture>
bool check_picture(const Picture& picture, const std::string& name, const std::string& field,
                   Findings& findings) {
  if (picture.has_scale() && picture.scale().u() == 0)
    findings.add(field + ".scale.u", "u must not be 0");
  if (picture.has_scale() && picture.scale().v() == 0)
    findings.add(field + ".scale.v", "v must not be 0");
  if (picture.file().empty()) {
    findings.add(field, name + " needs a file");
    return false;
  }
  if (has_extension(picture.file(), ".png") || has_extension(picture.file(), ".exr")) return true;
  findings.add(field + ".file",
               "file must end in .png or .exr (it is " + quoted(picture.file()) + ")");
  return false;
}

void check_colors(const v1::Texture& texture, const std::string& field, Findings& findings) {
  if (texture.spectrum_size() > 0)
    findings.add(field + ".spectrum", "an RGB has colours and no spectra (there are " +
                                          std::to_string(texture.spectrum_size()) + ")");
  if (texture.channel_size() > 0)
    findings.add(field + ".channel", "an RGB has its own channels, R, G and B");
}

}  // namespace

void check_texture(const v1::Texture& texture, const std::string& field, Findings& findings) {
  if (check_picture(texture, "texture", field, findings) &&
      !has_extension(texture.file(), ".png") && texture.use() != v1::Texture::BLEND)
    findings.add(field + ".file",
                 "of an INDEX and an RGB it must be a .png (it is " + quoted(texture.file()) + ")");

  if (texture.use() == v1::Texture::RGB) return check_colors(texture, field, findings);
  const int spectra = texture.spectrum_size();
  if (spectra == 0 || spectra > limits::max_texture_spectra)
    return findings.add(field + ".spectrum",
                        "a texture needs 1 to " + std::to_string(limits::max_texture_spectra) +
                            " spectra (it has " + std::to_string(spectra) + ")");
  for (int i = 0; i < spectra; ++i)
    check_spectrum(texture.spectrum(i), indexed(field + ".spectrum", static_cast<std::size_t>(i)),
                   SpectrumRole::property, findings);

  const bool index = texture.use() == v1::Texture::INDEX;
  const int wanted = index ? 1 : spectra;
  if (texture.channel_size() != 0 && texture.channel_size() != wanted)
    findings.add(field + ".channel",
                 (index ? "an INDEX needs 1 channel"
                        : "there must be a channel for each spectrum, " + std::to_string(spectra)) +
                     " (there are " + std::to_string(texture.channel_size()) + ")");
}

void check_map(const v1::Map& map, MapUse use, const std::string& field, Findings& findings) {
  check_picture(map, use == MapUse::alpha ? "alpha" : "map", field, findings);
  if (use == MapUse::normals && !map.channel().empty())
    findings.add(field + ".channel", "a normal map has its own channels, R, G and B");
  if (use == MapUse::alpha && map.has_strength())
    findings.add(field + ".strength", "an alpha has none: `cutoff` makes it hard");
  if (use != MapUse::alpha && map.has_cutoff())
    findings.add(field + ".cutoff", "only an alpha has one");
  if (map.has_strength())
    check_range(map.strength(), -limits::max_map_strength, limits::max_map_strength,
                field + ".strength", findings);
  if (map.has_cutoff()) check_range(map.cutoff(), 0, 1, field + ".cutoff", findings);
}

}  // namespace metamer
