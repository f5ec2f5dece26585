#pragma once

#include <optional>
#include <vector>

#include "common/mesh/triangle_mesh.h"
#include "common/problem.h"
#include "metamer/v1/import.pb.h"

namespace metamer::import {

/// A file descriptor that is closed with its owner; below 0: none.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  int get() const { return fd_; }
  int release();

 private:
  int fd_;
};

/// Writes meshes into new memory, which nobody can change or shorten afterwards, and describes
/// them. Each is freed as soon as it is written. Error: there is no memory.
Result<Descriptor> put_meshes(std::vector<TriangleMesh> meshes,
                              v1::MeshImported::Meshes& description);

/// The meshes in such memory, mapped. Nothing: the memory can change, is not of the size that is
/// described; more than limits::max_triangles; a position that is not finite or too far out, an
/// index that names none. For memory that comes from a process that may have been taken over.
std::optional<std::vector<TriangleMesh>> take_meshes(const Descriptor& memory,
                                                     const v1::MeshImported::Meshes& description);

}  // namespace metamer::import
