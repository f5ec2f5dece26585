#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "client/cli/options.h"
#include "client/cli/overrides.h"
#include "client/cli/report.h"
#include "common/scene/scene_file.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::cli {

/// A scene that is sound as far as this side can see, ready to be sent.
class SceneInput {
 public:
  /// Reads the scene, applies the overrides, checks it and all that it names. Prints every problem
  /// found; nothing then.
  static std::optional<SceneInput> load(const std::string& file, const Overrides& overrides,
                                        Report& report);

  const v1::Scene& scene() const { return file_.scene(); }
  const std::vector<Asset>& assets() const { return assets_; }
  std::string name() const;  ///< The file's name without its folder.

  /// Prints a problem, found here or by the server, at its place in the scene, in a file that the
  /// scene names, or at the option that caused it.
  void print(Problem problem, Report& report) const;
  void print_all(const std::vector<Problem>& problems, Report& report) const;
  void print(const v1::Notice& notice, Report& report) const;

 private:
  SceneInput(SceneFile file, std::filesystem::path folder)
      : file_(std::move(file)), folder_(std::move(folder)) {}
  bool check(Report& report);
  Problem locate(Problem problem) const;

  SceneFile file_;
  std::filesystem::path folder_;
  std::vector<Asset> assets_;
  std::vector<Replaced> replaced_;
};

}  // namespace metamer::cli
