#include "server/import/transfer.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "common/scene/limits.h"

namespace metamer::import {
namespace {

constexpr int seals = F_SEAL_SEAL | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE;

/// A mapping, for as long as an array of it is held.
std::shared_ptr<char> map(int fd, std::size_t size, int protection) {
  void* const at = mmap(nullptr, size, protection, MAP_SHARED, fd, 0);
  if (at == MAP_FAILED) return nullptr;
  return {static_cast<char*>(at), [size](char* from) { munmap(from, size); }};
}

/// Where the arrays of meshes lie, by their lengths alone: both sides count alike.
class Places {
 public:
  /// Of an array's first byte. False: more than any mesh may have.
  template <class T>
  bool next(std::uint64_t count, std::size_t& at) {
    at = end_;
    if (count > most) return false;
    end_ += (count * sizeof(T) + 63) / 64 * 64;
    return end_ <= largest;
  }
  std::size_t end() const { return end_; }

 private:
  /// Vertices and triangles. A vertex of its own for each corner is what a format may need.
  static constexpr std::uint64_t most = 3 * limits::max_triangles;
  static constexpr std::size_t largest = std::size_t{1} << 40;
  std::size_t end_ = 0;
};

/// Calls `each(array, length, element)` for a mesh's arrays in the order of the memory.
template <class Mesh, class Each>
bool for_each_array(const v1::MeshImported::Arrays& lengths, Mesh& mesh, Each each) {
  return each(lengths.positions_f32(), mesh.f32) && each(lengths.positions_f64(), mesh.f64) &&
         each(lengths.normals(), mesh.normals) && each(lengths.tangents(), mesh.tangents) &&
         each(lengths.triangles(), mesh.triangles) && each(lengths.uvs(), mesh.uvs);
}

struct Arrays {
  Array<Float3> f32;
  Array<Double3> f64;
  Array<Float3> normals, tangents;
  Array<Triangle> triangles;
  Array<Float2> uvs;
};

Arrays arrays_of(TriangleMesh mesh) {
  return {mesh.positions.f32(),     mesh.positions.f64(),      std::move(mesh.normals),
          std::move(mesh.tangents), std::move(mesh.triangles), std::move(mesh.uvs)};
}

v1::MeshImported::Arrays lengths_of(const TriangleMesh& mesh) {
  v1::MeshImported::Arrays lengths;
  lengths.set_positions_f32(mesh.positions.f32().size());
  lengths.set_positions_f64(mesh.positions.f64().size());
  lengths.set_normals(mesh.normals.size());
  lengths.set_tangents(mesh.tangents.size());
  lengths.set_triangles(mesh.triangles.size());
  lengths.set_uvs(mesh.uvs.size());
  lengths.set_skipped_faces(mesh.skipped_faces);
  for (const std::string& note : mesh.notes) lengths.add_note(note);
  return lengths;
}

template <class T>
bool usable(const Array<std::array<T, 3>>& positions) {
  const auto limit = static_cast<T>(limits::max_coordinate);
  bool all = true;  // Without an early end, so that it can be done several at a time.
  for (const auto& p : positions)
    all &= std::abs(p[0]) <= limit && std::abs(p[1]) <= limit && std::abs(p[2]) <= limit;
  return all;
}

bool finite(const Array<Float3>& vectors) {
  bool all = true;
  for (const auto& v : vectors)
    all &= std::abs(v[0]) <= 2 && std::abs(v[1]) <= 2 && std::abs(v[2]) <= 2;
  return all;
}

bool finite(const Array<Float2>& uvs) {
  bool all = true;
  for (const auto& uv : uvs) all &= std::isfinite(uv[0]) && std::isfinite(uv[1]);
  return all;
}

bool sound(const Arrays& mesh) {
  const std::size_t vertices = mesh.f32.size() + mesh.f64.size();
  const auto one_each = [&](const auto& list) { return list.empty() || list.size() == vertices; };
  if ((!mesh.f32.empty() && !mesh.f64.empty()) || !one_each(mesh.normals) ||
      !one_each(mesh.tangents) || !one_each(mesh.uvs) || mesh.triangles.empty())
    return false;
  std::uint32_t last = 0;
  for (const Triangle& corners : mesh.triangles)
    last = std::max({last, corners[0], corners[1], corners[2]});
  return last < vertices && usable(mesh.f32) && usable(mesh.f64) && finite(mesh.normals) &&
         finite(mesh.tangents) && finite(mesh.uvs);
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}
Descriptor::~Descriptor() {
  if (fd_ >= 0) close(fd_);
}
int Descriptor::release() { return std::exchange(fd_, -1); }

Result<Descriptor> put_meshes(std::vector<TriangleMesh> meshes,
                              v1::MeshImported::Meshes& description) {
  const auto failed = [] {
    return problem(std::string("there is no memory for it: ") + std::strerror(errno));
  };
  // Describe them, and count.
  Places places;
  Arrays none;
  for (const TriangleMesh& mesh : meshes) {
    *description.add_arrays() = lengths_of(mesh);
    for_each_array(*description.arrays().rbegin(), none,
                   [&]<class T>(std::uint64_t count, const Array<T>&) {
                     std::size_t at;
                     return places.next<T>(count, at);
                   });
  }
  // Write them.
  Descriptor memory(memfd_create("metamer-meshes", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (memory.get() < 0 || ftruncate(memory.get(), static_cast<off_t>(places.end())) != 0)
    return failed();
  if (const auto to = map(memory.get(), places.end(), PROT_READ | PROT_WRITE)) {
    Places again;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      Arrays arrays = arrays_of(std::move(meshes[i]));
      for_each_array(description.arrays(static_cast<int>(i)), arrays,
                     [&]<class T>(std::uint64_t count, Array<T>& array) {
                       std::size_t at;
                       again.next<T>(count, at);
                       if (count > 0) std::memcpy(to.get() + at, array.data(), count * sizeof(T));
                       array = {};
                       return true;
                     });
    }
  } else {
    return failed();
  }
  if (fcntl(memory.get(), F_ADD_SEALS, seals) != 0) return failed();
  return memory;
}

std::optional<std::vector<TriangleMesh>> take_meshes(const Descriptor& memory,
                                                     const v1::MeshImported::Meshes& description) {
  struct stat status {};
  if (fcntl(memory.get(), F_GET_SEALS) != seals || fstat(memory.get(), &status) != 0)
    return std::nullopt;
  const auto size = static_cast<std::size_t>(status.st_size);
  const std::shared_ptr<char> from = size > 0 ? map(memory.get(), size, PROT_READ) : nullptr;
  if (!from) return std::nullopt;

  std::vector<TriangleMesh> meshes;
  Places places;
  for (const v1::MeshImported::Arrays& lengths : description.arrays()) {
    Arrays arrays;
    const bool within =
        for_each_array(lengths, arrays, [&]<class T>(std::uint64_t count, Array<T>& array) {
          std::size_t at;
          if (!places.next<T>(count, at) || places.end() > size) return false;
          if (count > 0)
            array = Array<T>(from, {reinterpret_cast<const T*>(from.get() + at), count});
          return true;
        });
    if (!within || arrays.triangles.size() > limits::max_triangles || !sound(arrays))
      return std::nullopt;
    TriangleMesh& mesh = meshes.emplace_back();
    mesh.positions = arrays.f64.empty() ? Positions(arrays.f32) : Positions(arrays.f64);
    mesh.normals = arrays.normals;
    mesh.tangents = arrays.tangents;
    mesh.uvs = arrays.uvs;
    mesh.triangles = arrays.triangles;
    mesh.skipped_faces = lengths.skipped_faces();
    mesh.notes.assign(lengths.note().begin(), lengths.note().end());
  }
  return meshes;
}

}  // namespace metamer::import
