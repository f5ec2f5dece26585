#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/tools/scene/digest_cache.h"
#include "client/tools/scene/look.h"
#include "common/problem.h"
#include "common/scene/scene_file.h"

namespace metamer::client {

/// A scene as far as this side can check it: parsed, changed, validated, with the files that it
/// names, and all that is wrong with it, each problem at its place. Sound ones are ready to be
/// sent.
class CheckedScene {
 public:
  /// A change to a scene after it was parsed; says what it replaced.
  using Change = std::function<Result<std::vector<Replaced>>(v1::Scene&)>;

  /// Parses protobuf text; `file` is the name for messages, and lies in the folder that the
  /// scene's files are named from. Digests of unchanged files come from `digests`.
  static CheckedScene parse(std::string text, const std::filesystem::path& file,
                            DigestCache& digests, const Change& change = {});
  /// The same from a file of at most max_scene_text bytes.
  static CheckedScene read(const std::filesystem::path& file, DigestCache& digests,
                           const Change& change = {});

  bool sound() const { return problems_.empty(); }
  /// All that is wrong, located, in the scene's order; what one replacement broke in several
  /// places is told once. Where the text can't be parsed, or not be changed, that alone.
  const std::vector<Problem>& problems() const { return problems_; }

  /// The scene with its change; empty where the text can't be parsed.
  const v1::Scene& scene() const;
  /// The files that it names; none where one of them is wrong.
  const std::vector<Asset>& assets() const { return assets_; }
  /// The bytes of one that holds a spectrum or an observer, by its name in the scene: an
  /// AssetReader.
  Result<std::string> read_asset(const std::string& name) const;
  std::filesystem::path folder() const;
  std::string name() const { return file_.filename().string(); }
  /// As problems in its text name it.
  std::string file() const { return file_.string(); }

  /// Puts problems, found by anyone, at their places: in the scene's text, in a file that the scene
  /// names, or at what replaced the field ("--spp: must be above 0").
  std::vector<Problem> locate(const std::vector<Problem>& problems) const;
  Problem locate(Problem problem) const;

  /// How a person reads a located problem: with the line that it stands in, where that is at hand.
  std::string describe(const Problem& located) const;

 private:
  explicit CheckedScene(const std::filesystem::path& file) : file_(file) {}
  void check(DigestCache& digests);
  std::vector<Problem> check_spectra() const;
  const Asset* find_asset(std::string_view name) const;

  std::filesystem::path file_;
  std::string text_;  ///< Where it can't be parsed: parsed_ has it else.
  std::optional<SceneFile> parsed_;
  std::vector<Asset> assets_;
  std::vector<Replaced> replaced_;
  std::vector<Problem> problems_;
};

}  // namespace metamer::client
