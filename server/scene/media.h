#pragma once

#include <optional>

#include "common/problem.h"
#include "server/scene/render_scene.h"

/// What clear objects of a scene are filled with, and where that touches other things.
namespace metamer {

/// The Fraunhofer d line of helium, at which glasses have their index (ISO 7944).
inline constexpr double d_line_nm = 587.56;
double index_at_d_line(const Spectrum& n);

/// Adds a medium (behind air, which comes first) with what its transmittance says; its number.
std::uint32_t add_medium(RenderMedium medium, RenderScene& scene);

/// Fills in the interfaces of a scene with media: each with air, and those of two whose boxes
/// about all their objects touch. `placed` is the scene with its objects. An error where they are
/// too many (limits::max_interfaces).
std::optional<Problem> find_interfaces(RenderScene& scene, const RenderScene& placed);

/// Whether an object is a solid: a sphere, or a mesh each edge of which belongs to as many
/// triangles the one way as the other way (vertices of the same place count as one).
bool is_closed(const RenderScene& scene, const RenderObject& object);

/// Whether a mesh's triangles are clockwise, seen from outside: it encloses a volume below 0 in its
/// own space. It is closed.
bool is_turned_inwards(const TriangleMesh& mesh);

/// How often a closed object's surface goes around a point of the world, 0: it lies outside; by the
/// solid angles of its triangles (A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30, 125
/// (1983)). Below 0 for one that is turned inwards. Takes time with each triangle where the point
/// is in the object's box.
int windings(const RenderScene& scene, const RenderObject& object, const Eigen::Vector3d& point);

/// Whether a point of the world is no farther than `reach` from an object's surface, nearly: of an
/// ellipsoid by its shortest axis. Takes time with each triangle where it is that near to its box.
bool is_near(const RenderScene& scene, const RenderObject& object, const Eigen::Vector3d& point,
             double reach);

}  // namespace metamer
