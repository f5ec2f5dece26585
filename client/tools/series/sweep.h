#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "client/session/job_record.h"
#include "client/tools/pictures/comparison.h"
#include "client/tools/series/series_run.h"
#include "common/color/error_statistics.h"
#include "common/image/image.h"
#include "metamer/v1/scene.pb.h"

/// One scene with all combinations of some settings' values.
namespace metamer::client {

/// A setting and what it is in turn.
struct SweepAxis {
  std::string name;  ///< "method"
  std::vector<std::string> values;
};

/// Reads "method=exact,rgb", or, where values have commas, "wavelengths=400,500;450,550". Errors:
/// no name, an empty value, one that comes twice.
Result<SweepAxis> parse_axis(const std::string& text);

/// One combination.
struct SweepRow {
  std::vector<std::string> values;  ///< By axis.
  std::string label;                ///< "method=exact spp=4"
};

/// All of them, the last axis fastest. Error: more than max_rows.
Result<std::vector<SweepRow>> sweep_rows(const std::vector<SweepAxis>& axes);
inline constexpr std::size_t max_rows = 100'000;  ///< As a server takes them in one series.

/// Which row a person means: its number from 1, its label, or some of its values, where no other
/// has them: "method=exact". Errors: none, or several.
Result<std::size_t> find_row(const std::vector<SweepAxis>& axes, const std::vector<SweepRow>& rows,
                             const std::string& word);

/// What became of a row.
struct SweepOutcome {
  SweepRow row;
  std::string failure = "not finished";  ///< Why there is nothing else; empty: it rendered.
  JobHandle job;
  v1::Timing timing;
  v1::RunRecord record;
  std::optional<v1::Accuracy> accuracy;  ///< Of a row that was verified, or that has a goal.
  v1::Development development;           ///< How its picture is shown.
  bool is_reference = false;
  std::optional<ErrorStatistics> error;  ///< ΔE00 from the reference; of this itself nothing.
  std::optional<White> white;            ///< Of that ΔE00.
  /// Options by which it is shown otherwise than the reference, of which the ΔE00 knows nothing: it
  /// is that of the light of both pictures.
  std::vector<std::string> not_in_error;
  std::string uncompared;   ///< Why it has none.
  std::uint32_t width = 0;  ///< Of its picture.

  double cpu_seconds() const;
  std::string machines() const;  ///< "n1 n2": on which it was rendered.
};

/// Compares pictures with the reference's, in whatever order they end, in the thread that adds
/// them. The white is that of the dominant light, as in a trade.
class SweepComparison {
 public:
  /// A row's picture; the reference may come at any time, and those before it wait for it.
  void add(SweepOutcome& outcome, Image picture);
  void set_reference(Image picture, const v1::Plan& plan, const v1::Scene& scene);
  /// There will be none; of one that has come nothing changes.
  void give_up(const std::string& why);

 private:
  void compare_with(SweepOutcome& outcome, const Image& picture) const;

  std::optional<Image> reference_;
  std::string none_;  ///< Why there is none.
  White white_{};
  v1::Development development_;  ///< Of the reference.
  std::vector<std::pair<SweepOutcome*, Image>> waiting_;
};

/// RFC 4180, UTF-8, a line a row; numbers read back as the same doubles.
std::string sweep_csv(const std::vector<SweepAxis>& axes,
                      const std::vector<SweepOutcome>& outcomes);

}  // namespace metamer::client
