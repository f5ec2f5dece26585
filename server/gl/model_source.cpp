#include "server/gl/model_source.h"

namespace metamer::gl {
namespace {

using models::Entry, models::Kind;

/// The folder of a kind in shaders/, and what its functions' and structs' names end with.
struct Naming {
  const char *folder, *function_end, *struct_end;
};

Naming naming(Kind kind) {
  switch (kind) {
    case Kind::model:
      return {"models", "", ""};
    case Kind::diffuse:
      return {"diffuse", "_diffuse", "Diffuse"};
    case Kind::slope:
      return {"slopes", "_slope", "Slope"};
    case Kind::attenuation:
      return {"attenuations", "_attenuation", ""};
  }
  return {};
}

/// "struct BeckmannSlope { Real roughness; };": as common/models/all_models.cmake has it.
std::string struct_text(const Entry& entry) {
  if (entry.kind == Kind::attenuation) return "";
  std::string text = "struct " + struct_name(entry) + " {";
  if (entry.kind == Kind::model) text += " Real diffuseness; Real specularness;";
  for (const models::Parameter& parameter : entry.parameters)
    text += std::string(" Real ") + parameter.name + ";";
  return text + " };\n";
}

std::string source_text(const Entry& entry) {
  const std::string folder = naming(entry.kind).folder;
  return std::string(shader_text(folder + "/" + entry.name + ".glsl"));
}

}  // namespace

std::string function_name(const Entry& entry) {
  return std::string(entry.name) + naming(entry.kind).function_end;
}

std::string struct_name(const Entry& entry) {
  if (entry.kind == Kind::attenuation) return "";
  return std::string(entry.type) + naming(entry.kind).struct_end;
}

std::string prelude() {
  std::string text = "#version 450\n#define Real float\n#define Vec3 vec3\n#define Bool bool\n";
  for (const char* path : {"functions.glsl", "surface/vectors.glsl"}) text += shader_text(path);
  return text;
}

std::string model_source(const std::function<bool(const Entry&)>& wanted) {
  std::string text = prelude();
  for (const char* path :
       {"models/lobes.glsl", "models/masking.glsl", "models/ripples.glsl", "fresnel/schlick.glsl",
        "fresnel/fresnel.glsl", "fresnel/fold.glsl", "fresnel/nodes.glsl"})
    text += shader_text(path);
  for (const Kind kind : {Kind::model, Kind::diffuse, Kind::slope, Kind::attenuation}) {
    for (const Entry& entry : models::registry(kind))
      if (wanted(entry)) text += struct_text(entry) + source_text(entry);
  }
  return text;
}

}  // namespace metamer::gl
