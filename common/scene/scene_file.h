#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/digest.h"
#include "common/problem.h"
#include "common/scene/files.h"
#include "metamer/v1/scene.pb.h"

namespace metamer {

/// A scene as read from a file: the message, its text, and where each field of it stands.
/// Immutable and movable.
class SceneFile {
 public:
  /// Parses protobuf text format. Errors carry file, line and column; unknown fields, enum values
  /// and the like say what was perhaps meant. `file` is the name used in errors.
  static Result<SceneFile> parse(std::string text, std::string file);
  /// The same from a file of at most max_scene_text bytes.
  static Result<SceneFile> read(const std::filesystem::path& file);

  SceneFile(SceneFile&&) noexcept;
  SceneFile& operator=(SceneFile&&) noexcept;
  ~SceneFile();

  const v1::Scene& scene() const;
  v1::Scene& scene();  ///< For overrides; locations stay those of the text.
  const std::string& text() const;
  const std::string& file() const;

  /// Adds file, line and column to a problem that has only a field path ("light[0].spectrum.file",
  /// as validate_scene writes them). A field that the text leaves out is located at its nearest
  /// parent that the text has.
  Problem locate(Problem problem) const;

 private:
  struct State;
  explicit SceneFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

inline constexpr std::size_t max_scene_text = 16u << 20;  ///< A hundred thousand objects.

/// A file that the scene names.
struct Asset {
  std::string name;            ///< As the scene writes it.
  std::string field;           ///< Where the scene names it first: "object[2].mesh.file".
  std::filesystem::path path;  ///< The file, inside the scene's folder.
  std::size_t size = 0;        ///< Bytes.
  Digest sha256{};
};

/// Size and SHA-256 of a file of at most `limit` bytes: digest_file, or what remembers what it
/// said.
using DigestOf =
    std::function<Result<FileDigest>(const std::filesystem::path& file, std::uint64_t limit)>;

/// Every file that the scene names, once each, and the buffers that a .gltf names. Paths resolve
/// relative to `folder` and may not leave it, also not through "..", an absolute path or a
/// symbolic link. Those of the fields in `elsewhere` lie where that says. All the problems found: a
/// missing file, a folder, one over max_asset bytes.
using Elsewhere = std::map<std::string, std::filesystem::path>;
tl::expected<std::vector<Asset>, std::vector<Problem>> collect_assets(
    const v1::Scene& scene, const std::filesystem::path& folder,
    const DigestOf& digest_of = digest_file, const Elsewhere& elsewhere = {});

}  // namespace metamer
