#pragma once

#include "common/mesh/mesh_file.h"

namespace metamer {

/// Gives each vertex that has no normal the average of those of the triangles that meet at its
/// place, weighted by their angles there (Thürmer & Wüthrich, "Computing Vertex Normals from
/// Polygonal Facets", 1998). It depends neither on the order of triangles or vertices nor on
/// triangles without area. A vertex of such alone keeps 0.
void smooth_normals(MeshFile& mesh);

/// The same for a mesh without normals, but two triangles smooth the edge that they share only
/// where their normals are at most `degrees` apart; at other edges vertices are split. An edge of
/// more than eight triangles is sharp. So is one between two groups, or in group 0, of
/// MeshFile::smoothing, if there are any.
void creased_normals(MeshFile& mesh, double degrees);

/// Tangents towards rising u at each vertex, unit and at right angles to its normal: the average
/// over its triangles whose UVs are finite and span an area, weighted by their angles. 0: it has
/// none; empty: none has.
std::vector<Float3> tangents_of(const MeshFile& mesh);

}  // namespace metamer
