#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "server/scene/compiling.h"
#include "server/scene/mesh_import.h"

namespace metamer {

/// The objects of a scene that is compiled, and their meshes. Materials are there before.
class ObjectCompiler {
 public:
  /// `needs`: what materials ask of every mesh. `to` must outlive it.
  ObjectCompiler(const MeshNeeds& needs, Compiling& to) : needs_(needs), to_(to) {}

  /// Every mesh of the scene's files; before the objects. Leaves out the rest when `cancelled`.
  void import_files(const MeshImport& import, const std::atomic<bool>& cancelled);
  /// The `index`-th object.
  void object(int index);

 private:
  void take_meshes(Result<std::vector<TriangleMesh>> imported, const MeshRequest& request);
  std::uint32_t quad(const v1::Quad& quad);
  std::uint32_t material_named(const std::string& name);
  void check_place(const RenderObject& object, const std::string& field);
  void check_axes(const Eigen::Matrix3d& axes, const std::string& field);
  const Eigen::AlignedBox3d& bounds(std::uint32_t mesh);

  MeshNeeds needs_;
  Compiling& to_;
  std::map<std::string, std::uint32_t> meshes_;  ///< By mesh_key().
  std::map<std::string, std::uint32_t> materials_;
  std::vector<Eigen::AlignedBox3d> mesh_bounds_;
  bool told_of_phong_ = false;
};

}  // namespace metamer
