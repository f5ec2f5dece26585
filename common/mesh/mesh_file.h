#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"
#include "common/problem.h"

namespace metamer {

/// The triangles of a file that bear one name and one material, in a row.
struct MeshPiece {
  std::string object = {};    ///< Of a glTF's node, an OBJ's g, else its o; may be empty. UTF-8.
  std::string material = {};  ///< Its name in the file; may be empty. UTF-8.
  std::uint64_t first_triangle = 0, triangles = 0;
};

/// A mesh file as it was read: every triangle of it, nodes applied, and nothing computed that it
/// does not say.
struct MeshFile {
  std::vector<Float3> positions;       ///< Of a file with f32,
  std::vector<Double3> positions_f64;  ///< or with more; one of the two is empty.
  /// One for each position, unit; 0: the file has none there, and they are averaged over the
  /// triangles that meet at its place; empty: the file has none.
  std::vector<Float3> normals;
  /// Without normals: the angle of MeshUse::crease_angle where the use names none.
  std::optional<double> crease_angle;
  /// Without normals: of each triangle the group within which normals are averaged, 0: flat; empty:
  /// the file has no such groups. A crease angle that a use names goes before them.
  std::vector<std::uint32_t> smoothing;
  /// One for each position, v rising from the bottom of a picture; NaN: none there; or empty.
  std::vector<Float2> uvs;
  std::vector<Triangle> triangles;
  std::vector<MeshPiece> pieces;    ///< In the triangles' order; all triangles are in one.
  std::uint64_t skipped_faces = 0;  ///< Those that span no triangle: fewer than three corners.
  std::vector<std::string> notes;   ///< What was left out, as sentences.
};

/// What is to become of a file.
struct MeshUse {
  std::string part = {};                    ///< See select_part(); empty: all of it.
  std::optional<double> crease_angle = {};  ///< Degrees; see smooth_normals().
  bool tangents = false;                    ///< From the UVs, as far as there are any.
  bool uvs = false;                         ///< As they are.
};

/// The bytes of a file by its name; a mapped file is not copied.
using Bytes = Array<char>;
/// Files by their names: a .gltf names its buffers.
using MeshBytes = std::function<Result<Bytes>(const std::string& name)>;

/// Reads PLY, OBJ or glTF 2.0, by the extension of `name`. Only what the bytes can pay for is
/// allocated. Errors, located as far as the format has lines: a format or a required extension that
/// can't be read; no triangles; a vertex or a UV that is not finite, or beyond
/// limits::max_coordinate and f32; an index out of range; more than limits::max_triangles.
Result<MeshFile> read_mesh(const std::string& name, const MeshBytes& files);

/// A file's triangles as a renderer takes them. Errors: the part is not there (the names that are
/// there), or is the name of an object and of another's material.
Result<TriangleMesh> triangles_of(MeshFile file, const MeshUse& use);

}  // namespace metamer
