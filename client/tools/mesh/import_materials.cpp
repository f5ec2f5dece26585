#include "client/tools/mesh/import_materials.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "common/color/rgb_reflectance.h"
#include "common/color/srgb.h"
#include "common/mesh/obj/materials.h"
#include "common/scene/files.h"
#include "common/scene/limits.h"
#include "common/scene/parts.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

Rgb within_gamut(const Double3& linear) {
  Rgb rgb;
  for (std::size_t k = 0; k < 3; ++k) rgb[k] = std::clamp(linear[k], 0.0, 1.0);
  return rgb;
}

/// sRGB as people write it: "#C02020".
std::string hex_of(const Rgb& linear) {
  const auto byte = [](double x) {
    return static_cast<unsigned>(std::lround(255 * srgb::encode(x)));
  };
  char text[8];
  std::snprintf(text, sizeof text, "#%02X%02X%02X", byte(linear[0]), byte(linear[1]),
                byte(linear[2]));
  return text;
}

/// Six decimals are enough, and a text that people read.
double rounded(double value) { return std::round(1e6 * value) / 1e6; }

void set_color(const Rgb& color, v1::Spectrum& to) {
  if (color[0] == color[1] && color[1] == color[2]) return to.set_constant(rounded(color[0]));
  const Spectrum reflectance = reflectance_of_rgb(color);
  for (std::size_t i = 0; i < reflectance.nm.size(); ++i) {
    to.mutable_samples()->add_wavelength(reflectance.nm[i]);
    to.mutable_samples()->add_value(rounded(reflectance.values[i]));
  }
  to.set_interpolation(v1::Spectrum::LINEAR);
}

/// The names of the files behind a mtllib: all of it, or word by word.
std::vector<fs::path> find_libraries(const std::string& names, const fs::path& folder,
                                     std::vector<std::string>& left_out) {
  std::string slashes = names;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const auto whole = find_in_folder(slashes, folder, max_mtl, false);
  if (whole) return {*whole};
  std::vector<fs::path> found;
  std::istringstream words(slashes);
  for (std::string word; words >> word;) {
    const auto file = find_in_folder(word, folder, max_mtl, true);
    if (file)
      found.push_back(*file);
    else
      left_out.push_back("the materials of a .mtl: " + file.error().message);
  }
  return found;
}

std::string not_counted(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += ", and its " + word + " does not count";
  return text;
}

FileMaterial material_of(const MtlMaterial& from) {
  FileMaterial to{.name = from.name,
                  .base_color = from.diffuse.value_or(Double3{0.5, 0.5, 0.5}),
                  .specular = {},
                  .exponent = 0,
                  .remarks = {}};
  if (!from.diffuse) to.remarks += ", as it has no Kd";
  if (from.is_textured) to.remarks += ", times a texture";
  if (from.specular && from.shows_highlight && from.exponent && *from.exponent > 0) {
    to.specular = *from.specular;
    to.exponent = *from.exponent;
  }
  to.remarks += not_counted(from.left_out);
  return to;
}

/// Its base colour beside a picture, which has no factor: a grey is the weight of the diffuse lobe.
std::string factor_of(const Rgb& base, v1::Material& to) {
  if (base == Rgb{1, 1, 1}) return "";
  if (base[0] != base[1] || base[1] != base[2])
    return ", and its base colour " + hex_of(base) + " does not count";
  to.set_diffuseness(rounded(base[0]));
  return ", darkened by its base colour";
}

/// What of a surface is there, by the alpha of its colours' file.
std::string add_alpha(const GltfMaterial& from, const std::string& file, v1::Material& to) {
  v1::Map& alpha = *to.mutable_alpha();
  alpha.set_file(file);
  place(*from.base_color_picture, alpha);
  const double factor = from.base_alpha;
  if (from.alpha_mode == "BLEND")
    return factor == 1 ? "" : ", and the alpha of its base colour does not count";
  // alpha × factor against a cutoff; where it never comes to that, nothing is there.
  const double cutoff = factor > 0 ? from.alpha_cutoff / factor : 2;
  alpha.set_cutoff(rounded(std::clamp(cutoff, 0.0, 1.0)));
  return cutoff > 1 ? ", and its alphaCutoff is brought to 1" : "";
}

/// Takes a part of a material back that a scene may not have, such as a scale of 1e30. Returns why,
/// as words.
template <class Check>
std::string take_back(v1::Material& from, const char* part, const Check& check) {
  Findings findings;
  check(findings);
  const std::vector<Problem> problems = findings.take();
  if (problems.empty()) return "";
  from.GetReflection()->ClearField(&from, v1::Material::descriptor()->FindFieldByName(part));
  return problems.front().field + ": " + problems.front().message;
}

std::string add_colors(const GltfPicture& where, bool has_uvs, ImportedPictures& pictures,
                       v1::Material& to, bool& has_alpha) {
  const auto picture = pictures.picture(where, has_uvs);
  if (!picture) return ", times a texture (" + picture.error().message + ")";
  to.mutable_texture()->set_file(picture->file);
  to.mutable_texture()->set_use(v1::Texture::RGB);
  const std::string remarks = place(where, *to.mutable_texture());
  const std::string fault = take_back(to, "texture", [&](Findings& findings) {
    if (check_values(to.texture(), "texture", findings))
      check_texture(to.texture(), "texture", findings);
  });
  has_alpha = picture->has_alpha && fault.empty();
  return fault.empty() ? remarks : ", times a texture (" + fault + ")";
}

std::string add_normals(const GltfPicture& where, bool has_uvs, ImportedPictures& pictures,
                        v1::Material& to) {
  const auto left_out = [](const std::string& why) {
    return ", and its normalTexture does not count (" + why + ")";
  };
  const auto picture = pictures.picture(where, has_uvs);
  if (!picture) return left_out(picture.error().message);
  if (!picture->has_colors) return left_out("it has no R, G and B");
  v1::Map& normals = *to.mutable_normal_map();
  normals.set_file(picture->file);
  if (where.strength != 1) normals.set_strength(where.strength);
  const std::string remarks = place(where, normals);
  const std::string fault = take_back(to, "normal_map", [&](Findings& findings) {
    if (check_values(normals, "normal_map", findings))
      check_map(normals, MapUse::normals, "normal_map", findings);
  });
  return fault.empty() ? remarks : left_out(fault);
}

/// Returns what of them is left out.
std::string add_pictures(const GltfMaterial& from, bool has_uvs, ImportedPictures& pictures,
                         v1::Material& to) {
  std::string remarks;
  bool has_alpha = false;
  if (from.base_color_picture)
    remarks += add_colors(*from.base_color_picture, has_uvs, pictures, to, has_alpha);
  const bool wants_alpha = from.alpha_mode == "MASK" || from.alpha_mode == "BLEND";
  if (wants_alpha && has_alpha)
    remarks += add_alpha(from, to.texture().file(), to);
  else if (wants_alpha && !to.has_texture())
    remarks += ", and its alphaMode " + from.alpha_mode + " does not count";
  else if (wants_alpha && from.base_alpha != 1)
    remarks += ", and the alpha of its base colour does not count";
  else if (!wants_alpha && !from.alpha_mode.empty() && from.alpha_mode != "OPAQUE")
    remarks += ", and its alphaMode " + quoted(from.alpha_mode) + " is none";
  if (from.normal_picture) remarks += add_normals(*from.normal_picture, has_uvs, pictures, to);
  return remarks;
}

void add_library(const fs::path& file, FileMaterials& to) {
  const std::string name = file.filename().string();
  const auto text = read_file(file, max_mtl);
  if (!text) {
    to.left_out.push_back("the materials of " + quoted(name) + ", which can't be read");
    return;
  }
  const MtlFile library = read_mtl(*text);
  for (const std::string& note : library.notes) to.left_out.push_back(quoted(name) + ": " + note);
  for (const MtlMaterial& one : library.materials) to.materials.push_back(material_of(one));
}

}  // namespace

FileMaterials materials_of(const GltfScene& scene) {
  FileMaterials result;
  for (const GltfMaterial& from : scene.materials)
    result.materials.push_back(
        {.name = from.name,
         .base_color = from.base_color,
         .specular = {},
         .exponent = 0,
         .remarks =
             std::string(from.is_textured && !from.base_color_picture ? ", times a texture" : "") +
             (from.is_metallic ? ", and it is a metal" : "") + not_counted(from.left_out),
         .gltf = from});
  return result;
}

FileMaterials load_obj_materials(const fs::path& obj) {
  FileMaterials result;
  const auto text = read_file(obj, limits::max_asset);
  if (!text) return result;
  const fs::path folder = obj.parent_path().empty() ? fs::path(".") : obj.parent_path();
  for (const std::string& names : mtl_names(*text))
    for (const fs::path& file : find_libraries(names, folder, result.left_out))
      add_library(file, result);
  return result;
}

std::string fill(const FileMaterial& from, bool has_uvs, ImportedPictures& pictures,
                 v1::Material& to) {
  const Rgb base = within_gamut(from.base_color);
  std::string remarks = from.remarks;
  if (from.gltf) remarks = add_pictures(*from.gltf, has_uvs, pictures, to) + remarks;
  std::string said = "material " + quoted(from.name) + ": ";
  if (to.has_texture()) {
    said += "its colours are those of " + quoted(to.texture().file()) + factor_of(base, to);
  } else {
    set_color(base, *to.mutable_diffuse());
    said += "its base colour is " + hex_of(base);
  }
  said += remarks + "; a reflectance that looks so under D65 stands for it";
  if (base != from.base_color) said += ", as it goes beyond 0..1";
  const double strength = *std::max_element(from.specular.begin(), from.specular.end());
  if (!(strength > 0)) return said;

  // A highlight: its colour, and how strong it is.
  Double3 color = from.specular;
  for (double& value : color) value /= strength;
  if (color[0] != color[1] || color[1] != color[2])
    set_color(within_gamut(color), *to.mutable_specular());
  const double specularness = std::min(strength, 1.0);
  to.set_specularness(rounded(specularness));
  const double exponent = std::clamp(from.exponent, 1.0, 1e6);
  to.mutable_blinn_phong()->set_shininess(exponent);
  if (exponent != from.exponent || specularness != strength)
    said += "; its highlight is brought into the range of blinn_phong";
  return said;
}

}  // namespace metamer::client
