#pragma once

#include <string>

#include "common/scene/findings.h"
#include "metamer/v1/scene.pb.h"

/// The checks of a scene's parts, behind validate_scene: each adds what is wrong with one part that
/// stands at `field`. Names are checked where all of them are known, in validate.cpp.
namespace metamer {

void check_camera(const v1::Camera& camera, const std::string& field, Findings& findings);
void check_luminance(double luminance, const std::string& field, Findings& findings);
void check_light(const v1::Light& light, const std::string& field, Findings& findings);
void check_material(const v1::Material& material, const std::string& field, Findings& findings);
void check_reflection(const v1::Material& material, const std::string& field, Findings& findings);
void check_fluorescence(const v1::Fluorescence& fluorescence, const std::string& field,
                        Findings& findings);
void check_fresnel(const v1::Fresnel& fresnel, const std::string& field, Findings& findings);
void check_texture(const v1::Texture& texture, const std::string& field, Findings& findings);
enum class MapUse : unsigned char { normals, heights, alpha };
void check_map(const v1::Map& map, MapUse use, const std::string& field, Findings& findings);
void check_transmission(const v1::Material& material, const std::string& field, Findings& findings);
void check_object(const v1::Object& object, const std::string& field, Findings& findings);
void check_transforms(const v1::Object& object, const std::string& field, Findings& findings);
void check_development(const v1::Development& development, const std::string& field,
                       Findings& findings);
void check_settings(const v1::Settings& settings, const std::string& field, Findings& findings);

}  // namespace metamer
