#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/cli/output/output.h"
#include "client/tools/series/frame_name.h"

namespace metamer::cli {

/// The files of a series' pictures, by the numbers that are in their names.
class SeriesOutput {
 public:
  /// `files` of the options are patterns; `option` is what they are called. `numbers`: those that
  /// will come, at least one. `sheet`: a .png, or empty. Nothing: one of them can't be written, or
  /// would be written twice, which is said.
  static std::optional<SeriesOutput> read(const OutputOptions& options, const std::string& option,
                                          const std::string& sheet,
                                          const std::vector<std::uint32_t>& numbers,
                                          Report& report);

  const std::vector<client::FrameName>& names() const { return names_; }
  std::vector<std::string> files(std::uint32_t number) const;
  /// What of a job has to be asked for.
  JobParts parts() const { return wanted(options_); }
  /// As write_output does.
  ExitCode write(std::uint32_t number, JobRecord& job, const std::string& name,
                 Report& report) const;

 private:
  /// The first file that stands for two of the pictures, or for one and the sheet; empty: none.
  std::string named_twice(const std::string& sheet,
                          const std::vector<std::uint32_t>& numbers) const;

  OutputOptions options_;
  std::vector<client::FrameName> names_;
};

}  // namespace metamer::cli
