#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/cli/exit_code.h"
#include "client/cli/report.h"
#include "client/session/job_record.h"
#include "client/tools/pictures/contact_sheet.h"
#include "common/image/image.h"

namespace metamer::cli {

/// The contact sheet of a series: each of its pictures, or of many of them some, under its label.
class SeriesSheet {
 public:
  /// No `file`: there is no sheet.
  SeriesSheet(std::string file, std::uint32_t count);

  /// A picture that is there, or nothing but its label.
  void add(std::uint32_t index, const std::string& label, const client::JobRecord* job);
  /// What stands below it.
  void note(std::uint32_t index, const std::string& words);
  ExitCode write(Report& report);

 private:
  std::string file_;
  std::uint32_t every_;  ///< Of the pictures the first of so many.
  std::vector<client::SheetCell> cells_;
  Developing developing_;
};

}  // namespace metamer::cli
