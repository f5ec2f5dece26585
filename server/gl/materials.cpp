#include "server/gl/materials.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <set>

#include "common/scene/rough_lobe_table.h"
#include "server/gl/model_source.h"

namespace metamer::gl {
namespace {

using models::Entry, models::Kind;

constexpr std::size_t parameter_count = models::max_parameters + 2;

/// Where a material's words are.
enum Place : std::uint32_t {
  model,
  diffuse_term,
  slope_count,
  attenuation,
  roughness,
  fresnel,
  diffuse_row,
  specular_row,
  first_node,
  first_lobe,
  ambient,
  parameters,
  diffuse_parameters = parameters + parameter_count,
  slopes = diffuse_parameters + parameter_count,  ///< Each: which, weight, parameters.
  slope_size = 2 + parameter_count,
  size = slopes + models::max_slopes * slope_size,
};

using Words = std::vector<std::uint32_t>;

void set(Words& words, std::size_t at, const models::Reflection<float>::Parameters& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    words[at + i] = std::bit_cast<std::uint32_t>(values[i]);
}

/// Whether a scene's materials use a line of models.def.
class Used {
 public:
  explicit Used(const RenderScene& scene) {
    for (const RenderMaterial& material : scene.materials) {
      const models::Reflection<float>& own = material.reflection;
      add(Kind::model, own.model);
      add(Kind::diffuse, own.diffuse);
      if (own.slope_count > 0) add(Kind::attenuation, own.attenuation);
      for (std::size_t i = 0; i < own.slope_count; ++i) add(Kind::slope, own.slopes[i].slope);
    }
  }
  bool operator()(const Entry& entry) const { return used_.contains({entry.kind, entry.index}); }

 private:
  void add(Kind kind, auto which) { used_.emplace(kind, static_cast<unsigned char>(which)); }

  std::set<std::pair<Kind, unsigned char>> used_;
};

/// What add_rough of shaders/stages/reflect.glsl looks at.
std::string rough_source(const RenderScene& scene) {
  const bool has_rough =
      std::any_of(scene.materials.begin(), scene.materials.end(),
                  [](const RenderMaterial& m) { return m.has(models::diffracting); });
  const std::string count = std::to_string(lobe_wavelengths);
  std::string text = std::string("const bool has_rough = ") + (has_rough ? "true" : "false") +
                     ";\nconst int lobe_cosines = " + std::to_string(lobe_cosines) +
                     ", lobe_wavelengths = " + count + ";\nconst float lobe_nm[" + count +
                     "] = float[" + count + "](";
  for (std::uint32_t w = 0; w < lobe_wavelengths; ++w)
    text += (w ? ", " : "") + std::to_string(lobe_nm(w));
  return text + ");\n";
}

std::string number(std::uint32_t value) { return std::to_string(value) + "u"; }

/// "BeckmannSlope(real_of(at + 2u))"
std::string arguments(const Entry& entry, const std::string& at) {
  std::string text = struct_name(entry) + "(";
  const std::size_t count = entry.parameters.size() + (entry.kind == Kind::model ? 2 : 0);
  for (std::size_t i = 0; i < count; ++i)
    text += (i ? ", real_of(" : "real_of(") + at + " + " + number(static_cast<unsigned>(i)) + ")";
  return text + ")";
}

/// A switch over the lines of one kind that are used.
std::string choice(Kind kind, const Used& used, const std::string& which,
                   const std::function<std::string(const Entry&)>& statement) {
  std::string text = "    switch (" + which + ") {\n";
  for (const Entry& entry : models::registry(kind))
    if (used(entry))
      text += "        case " + number(entry.index) + ": " + statement(entry) + " break;\n";
  return text + "        default: break;\n    }\n";
}

}  // namespace

Words material_words(const RenderScene& scene, const FactorRows& rows) {
  Words all;
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m) {
    const RenderMaterial& material = scene.materials[m];
    const models::Reflection<float>& own = material.reflection;
    Words words(Place::size);
    words[model] = static_cast<std::uint32_t>(own.model);
    words[diffuse_term] = static_cast<std::uint32_t>(own.diffuse);
    words[slope_count] = static_cast<std::uint32_t>(own.slope_count);
    words[attenuation] = static_cast<std::uint32_t>(own.attenuation);
    words[roughness] = std::bit_cast<std::uint32_t>(own.roughness);
    words[fresnel] = static_cast<std::uint32_t>(material.fresnel);
    words[diffuse_row] = rows.direct_diffuse(m);
    words[specular_row] = rows.specular(m);
    words[first_node] = rows.row({FactorKind::fresnel, m, 0});
    if (material.has(models::diffracting)) words[first_lobe] = rows.row({FactorKind::lobe, m, 0});
    words[ambient] = material.has(models::has_ambient);
    set(words, parameters, own.parameters);
    set(words, diffuse_parameters, own.diffuse_parameters);
    for (std::size_t i = 0; i < own.slope_count; ++i) {
      const std::size_t at = slopes + i * slope_size;
      words[at] = static_cast<std::uint32_t>(own.slopes[i].slope);
      words[at + 1] = std::bit_cast<std::uint32_t>(own.slopes[i].weight);
      set(words, at + 2, own.slopes[i].parameters);
    }
    all.insert(all.end(), words.begin(), words.end());
  }
  return all;
}

std::string material_source(const RenderScene& scene) {
  const Used used(scene);
  std::string text = model_source([&](const Entry& entry) { return used(entry); });
  const auto constant = [&](const char* name, std::uint32_t value) {
    text += std::string("const uint ") + name + " = " + number(value) + ";\n";
  };
  constant("material_size", Place::size);
  constant("material_fresnel", fresnel);
  constant("material_diffuse", diffuse_row);
  constant("material_specular", specular_row);
  constant("material_first_node", first_node);
  constant("material_first_lobe", first_lobe);
  constant("material_ambient", ambient);
  text += rough_source(scene);
  const NeededAngles needed = needed_angles(scene);
  text += std::string("const bool needs_azimuth = ") + (needed.azimuth ? "true" : "false") +
          ", needs_tangent = " + (needed.tangent ? "true" : "false") + ";\n";
  text +=
      "layout(std430, binding = 14) readonly buffer Materials { uint word_of[]; };\n"
      "float real_of(uint at) { return uintBitsToFloat(word_of[at]); }\n";

  // The parts that the models leave open.
  text +=
      "Terms terms_of(uint base, Angles angles) {\n    Terms terms = Terms(angles.n_dot_l, 0.0, "
      "0.0);\n";
  text += choice(Kind::diffuse, used, "word_of[base + " + number(diffuse_term) + "]",
                 [](const Entry& entry) {
                   return "terms.diffuse = " + function_name(entry) + "(angles, " +
                          arguments(entry, "base + " + number(diffuse_parameters)) + ");";
                 });
  text += "    for (uint i = 0u; i < word_of[base + " + number(slope_count) +
          "]; ++i) {\n    uint at = base + " + number(slopes) + " + i * " + number(slope_size) +
          ";\n    float weight = real_of(at + 1u);\n";
  text += choice(Kind::slope, used, "word_of[at]", [](const Entry& entry) {
    return "terms.slope += weight * " + function_name(entry) + "(angles, " +
           arguments(entry, "at + 2u") + ");";
  });
  text += "    }\n    if (word_of[base + " + number(slope_count) + "] > 0u)\n";
  text += choice(Kind::attenuation, used, "word_of[base + " + number(attenuation) + "]",
                 [](const Entry& entry) {
                   return "terms.attenuation = " + function_name(entry) +
                          "(angles, real_of(base + " + number(roughness) + "));";
                 });
  text += "    return terms;\n}\n";

  // The models.
  text +=
      "Lobes reflection(uint base, Angles angles) {\n    Terms terms = terms_of(base, angles);\n"
      "    Lobes lobes = Lobes(0.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0);\n";
  text +=
      choice(Kind::model, used, "word_of[base + " + number(model) + "]", [](const Entry& entry) {
        return "lobes = " + function_name(entry) + "(angles, terms, " +
               arguments(entry, "base + " + number(parameters)) + ");";
      });
  return text + "    return lobes;\n}\n";
}

}  // namespace metamer::gl
