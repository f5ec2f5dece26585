#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/problem.h"

namespace metamer {

/// The largest .gltf: its bulk data belongs into a .bin or .glb, and JSON expands when it is read.
inline constexpr std::size_t max_gltf_text = 16u << 20;
/// The most buffers of one .gltf; exporters write one.
inline constexpr std::size_t max_gltf_buffers = 64;

/// Undoes %20 and the like (RFC 3986, 2.1); nothing when a % is not followed by two digits.
std::optional<std::string> percent_decode(std::string_view uri);

/// The file that a URI of a buffer or image names, relative to the scene's folder: of
/// "mesh/a.gltf", "b%20c.bin" is "mesh/b c.bin". Errors: a scheme, no URI.
Result<std::string> file_of_uri(const std::string& uri, const std::string& name,
                                const char* what = "buffer");

/// The files that hold the buffers of a .gltf named `name`, as names relative to the scene's
/// folder: "meshes/lamp.gltf" with the URI "lamp%20data.bin" gives "meshes/lamp data.bin". data:
/// URIs need no file. Errors: no JSON, no glTF 2.0, a URI with a scheme, more than
/// max_gltf_buffers.
Result<std::vector<std::string>> gltf_buffers(std::string_view text, const std::string& name);

}  // namespace metamer
