#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace metamer {

enum class GridFormat { ply, ply_text, obj, glb };

std::string format_name(GridFormat format);

/// Writes a bumpy sheet of about so many bytes, with or without normals; returns its file.
std::filesystem::path write_grid(GridFormat format, bool normals, std::size_t bytes,
                                 const std::filesystem::path& folder);

}  // namespace metamer
