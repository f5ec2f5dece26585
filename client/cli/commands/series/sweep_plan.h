#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "client/cli/commands/series/series_output.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/tools/scene/checked_scene.h"
#include "client/tools/series/sweep.h"

namespace metamer::cli {

struct SweepOptions {
  CommonOptions common;
  std::string scene;
  std::vector<std::string> vary;
  std::string reference = "1";
  std::string folder, sheet;
  OutputOptions pictures;
  Overrides overrides;
};

/// A sweep's options, understood.
struct Sweep {
  const SweepOptions& options;
  std::vector<client::SweepAxis> axes;  ///< Each by the name of an option that changes a scene.
  std::vector<client::SweepRow> rows;
  std::vector<std::size_t> order;  ///< In which they are submitted: the reference is the first.
  SeriesOutput pictures;
};

/// Nothing: the options make no sense, which is said. Makes the folder.
std::optional<Sweep> understand(const SweepOptions& options, Report& report);

/// The scenes of a sweep's rows, each read as `render` reads it with these options.
class SweepScenes {
 public:
  explicit SweepScenes(const Sweep& sweep) : sweep_(sweep) {}

  /// Error: the first of what is wrong with it.
  Result<client::CheckedScene> scene(std::size_t row);
  /// False: the reference can't be rendered, which is said, and nothing would compare with it.
  bool check(Report& report);

 private:
  const Sweep& sweep_;
  client::DigestCache digests_;
};

}  // namespace metamer::cli
