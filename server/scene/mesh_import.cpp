#include "server/scene/mesh_import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/BaseImporter.h>
#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>

#include "common/scene/gltf.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"

/// What Assimp calls where one of its assertions fails: Debian's build keeps them, and would end
/// the process. An exception ends the import alone.
namespace Assimp {
void aiAssertViolation(const char* expression, const char* file, int line);
void aiAssertViolation(const char* expression, const char*, int) {
  throw std::runtime_error(std::string("Assimp expects ") + expression);
}
}  // namespace Assimp

namespace metamer {
namespace {

/// An asset's bytes, as Assimp reads files.
class AssetStream : public Assimp::IOStream {
 public:
  explicit AssetStream(std::string bytes) : bytes_(std::move(bytes)) {}

  size_t Read(void* to, size_t size, size_t count) override {
    if (size == 0) return 0;
    const size_t whole = std::min(count, (bytes_.size() - position_) / size);
    std::memcpy(to, bytes_.data() + position_, whole * size);
    position_ += whole * size;
    return whole;
  }
  size_t Write(const void*, size_t, size_t) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override {
    const size_t base = origin == aiOrigin_SET   ? 0
                        : origin == aiOrigin_CUR ? position_
                                                 : bytes_.size();
    if (offset > bytes_.size() - base) return aiReturn_FAILURE;
    position_ = base + offset;
    return aiReturn_SUCCESS;
  }
  size_t Tell() const override { return position_; }
  size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::string bytes_;
  size_t position_ = 0;
};

/// Gives Assimp the job's assets and no other file.
class AssetSystem : public Assimp::IOSystem {
 public:
  explicit AssetSystem(const AssetReader& assets) : assets_(assets) {}

  bool Exists(const char* name) const override { return read(name).has_value(); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (std::strchr(mode, 'r') == nullptr) return nullptr;
    auto bytes = read(name);
    return bytes ? new AssetStream(std::move(*bytes)) : nullptr;
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  /// A mesh is asked for as the scene writes it, a glTF's buffer as gltf_buffers names it.
  Result<std::string> read(const std::string& name) const {
    if (auto bytes = assets_(name)) return bytes;
    const std::string path = percent_decode(name).value_or(name);
    return assets_(std::filesystem::path(path).lexically_normal().generic_string());
  }
  const AssetReader& assets_;
};

bool usable(const aiVector3D& v) {
  const auto limit = static_cast<float>(limits::max_coordinate);
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

std::uint64_t count_faces(const aiScene& scene) {
  std::uint64_t faces = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) faces += scene.mMeshes[m]->mNumFaces;
  return faces;
}

/// What is wrong with a file's raw meshes. Before any post-processing: joining vertices would take
/// NaN for equal to whatever it is compared with.
Result<void> check(const aiScene& scene) {
  std::uint64_t vertices = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned i = 0; i < mesh.mNumVertices; ++i, ++vertices)
      if (!usable(mesh.mVertices[i]))
        return problem("vertex " + std::to_string(vertices) + " is not finite or too far out");
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      for (unsigned corner = 0; corner < mesh.mFaces[f].mNumIndices; ++corner)
        if (mesh.mFaces[f].mIndices[corner] >= mesh.mNumVertices)
          return problem("face " + std::to_string(f) + " names vertex " +
                         std::to_string(mesh.mFaces[f].mIndices[corner]) + "; there are " +
                         std::to_string(mesh.mNumVertices));
  }
  if (const std::uint64_t faces = count_faces(scene); faces > limits::max_triangles)
    return problem("holds " + std::to_string(faces) + " faces; at most " +
                   std::to_string(limits::max_triangles) + " are allowed");
  return {};
}

/// Takes away the faces that have no area by their count of corners: Assimp's next steps would
/// assert that there are none without corners, and leave the vertices of points and lines without
/// normals. Returns how many there were.
std::uint64_t drop_points_and_lines(aiScene& scene) {
  std::uint64_t dropped = 0;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    aiMesh& mesh = *scene.mMeshes[m];
    aiFace* const end = mesh.mFaces + mesh.mNumFaces;
    aiFace* const kept =
        std::remove_if(mesh.mFaces, end, [](const aiFace& face) { return face.mNumIndices < 3; });
    if (kept == end) continue;
    dropped += static_cast<std::uint64_t>(end - kept);
    mesh.mNumFaces = static_cast<unsigned>(kept - mesh.mFaces);
    mesh.mPrimitiveTypes = 0;
    for (const aiFace* face = mesh.mFaces; face != kept; ++face)
      mesh.mPrimitiveTypes |=
          face->mNumIndices == 3 ? aiPrimitiveType_TRIANGLE : aiPrimitiveType_POLYGON;
  }
  return dropped;
}

/// Leaves Assimp the readers of the file's own extension. It would try 40 others on a file that
/// they refuse.
void keep_readers_of(const std::string& name, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const reader = importer.GetImporter(i);
    std::set<std::string> extensions;
    reader->GetExtensionList(extensions);
    if (std::any_of(extensions.begin(), extensions.end(),
                    [&](const std::string& own) { return has_extension(name, "." + own); }))
      continue;
    importer.UnregisterLoader(reader);
    delete reader;  // No longer the importer's.
  }
}

/// Which vertices have a direction of rising u: those of a triangle whose UVs are finite and span
/// an area. A file may name UVs for some of its faces, or the same one everywhere.
std::vector<bool> directed(const aiMesh& mesh) {
  std::vector<bool> result(mesh.mNumVertices, false);
  if (!mesh.HasTangentsAndBitangents() || !mesh.HasTextureCoords(0)) return result;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    const auto uv = [&](unsigned corner) { return mesh.mTextureCoords[0][face.mIndices[corner]]; };
    const aiVector3D a = uv(1) - uv(0), b = uv(2) - uv(0);
    const float area = std::abs(a.x * b.y - a.y * b.x);
    const float sides = std::hypot(a.x, a.y) * std::hypot(b.x, b.y);
    if (!(area > 1e-6f * sides) || !std::isfinite(sides)) continue;
    for (unsigned corner = 0; corner < 3; ++corner) result[face.mIndices[corner]] = true;
  }
  return result;
}

/// Some mesh repeats a vertex for each triangle at it, as formats without an index do. Looking for
/// what is equal takes as long as reading the file.
bool repeats_vertices(const aiScene& scene) {
  return std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes, [](const aiMesh* mesh) {
    return mesh->mNumFaces > 1 && mesh->mNumVertices >= 3 * std::uint64_t{mesh->mNumFaces};
  });
}

/// Appends one mesh of a file to the joined one.
void append(const aiMesh& from, bool tangents, TriangleMesh& to) {
  const auto base = static_cast<std::uint32_t>(to.positions.size());
  const std::vector<bool> has_direction = tangents ? directed(from) : std::vector<bool>();
  for (unsigned i = 0; i < from.mNumVertices; ++i) {
    const aiVector3D& position = from.mVertices[i];
    to.positions.push_back({position.x, position.y, position.z});
    aiVector3D normal = from.mNormals[i];
    // A vertex of zero-area triangles alone has no normal; Assimp writes NaN there.
    if (!std::isfinite(normal.SquareLength()) || normal.SquareLength() == 0) normal = {0, 0, 0};
    normal.NormalizeSafe();
    to.normals.push_back({normal.x, normal.y, normal.z});
    if (!tangents) continue;
    aiVector3D tangent;  // Towards rising u.
    if (has_direction[i]) tangent = from.mTangents[i];
    if (!std::isfinite(tangent.SquareLength())) tangent = {0, 0, 0};
    tangent.NormalizeSafe();
    to.tangents.push_back({tangent.x, tangent.y, tangent.z});
  }
  for (unsigned i = 0; i < from.mNumFaces; ++i) {
    const aiFace& face = from.mFaces[i];
    if (face.mNumIndices == 3)
      to.triangles.push_back(
          {base + face.mIndices[0], base + face.mIndices[1], base + face.mIndices[2]});
  }
}

}  // namespace

Result<TriangleMesh> import_mesh(const std::string& name, const AssetReader& assets,
                                 bool tangents) {
  const auto fail = [&](std::string message) {
    return tl::unexpected(Problem{.field = {}, .file = name, .message = std::move(message)});
  };

  Assimp::Importer importer;
  const auto reason = [&](const std::string& what) {
    const std::string error = importer.GetErrorString();
    const bool empty = error.find("No output meshes") != std::string::npos;
    return empty ? "holds no triangles" : what + error;
  };

  // Let Assimp read the file as it is.
  importer.SetIOHandler(new AssetSystem(assets));
  keep_readers_of(name, importer);
  const aiScene* scene = importer.ReadFile(name, 0);
  if (scene == nullptr) return fail(reason("can't be read as a mesh: "));
  if (auto sound = check(*scene); !sound) return fail(std::move(sound.error().message));
  TriangleMesh mesh;
  mesh.skipped_faces = drop_points_and_lines(const_cast<aiScene&>(*scene));
  if (count_faces(*scene) == 0) return fail("holds no triangles");

  // Let it make triangles of polygons, one node of all, and normals where the file has none.
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_GenSmoothNormals |
                   aiProcess_PreTransformVertices;
  if (repeats_vertices(*scene)) steps |= aiProcess_JoinIdenticalVertices;
  if (tangents) steps |= aiProcess_CalcTangentSpace;
  scene = importer.ApplyPostProcessing(steps);
  if (scene == nullptr) return fail(reason("can't be made of triangles: "));

  // Join its meshes.
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& part = *scene->mMeshes[i];
    if (!std::all_of(part.mVertices, part.mVertices + part.mNumVertices, usable))
      return fail("moves a vertex by its own nodes to where it is not finite or too far out");
    append(part, tangents, mesh);
  }
  if (mesh.triangles.empty()) return fail("holds no triangles");
  const auto none = [](const std::array<float, 3>& v) { return v == std::array<float, 3>{}; };
  if (std::all_of(mesh.tangents.begin(), mesh.tangents.end(), none)) mesh.tangents.clear();
  return mesh;
}

}  // namespace metamer
