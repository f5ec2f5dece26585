#include "client/cli/commands/series/series_output.h"

#include "client/tools/pictures/save_pictures.h"

namespace metamer::cli {

std::optional<SeriesOutput> SeriesOutput::read(const OutputOptions& options,
                                               const std::string& option, const std::string& sheet,
                                               std::uint32_t first, Report& report) {
  SeriesOutput output;
  output.options_ = options;
  bool good = true;
  for (const std::string& pattern : options.files) {
    auto name = client::FrameName::parse(pattern);
    if (name) {
      output.names_.push_back(std::move(*name));
      continue;
    }
    report.error(option + ": " + name.error().message);
    good = false;
  }
  if (!sheet.empty()) {
    std::string wrong = client::objection(sheet, client::FileContent::picture);
    if (wrong.empty() && client::is_exr(sheet)) wrong = quoted(sheet) + " is no .png";
    if (!wrong.empty()) report.error("--sheet: " + wrong);
    good = good && wrong.empty();
  }
  OutputOptions checked = options;
  checked.files = output.files(first);
  if (!good || check_output(checked, report) != ExitCode::done) return std::nullopt;
  return output;
}

std::vector<std::string> SeriesOutput::files(std::uint32_t number) const {
  std::vector<std::string> files;
  for (const client::FrameName& name : names_) files.push_back(name.of(number));
  return files;
}

ExitCode SeriesOutput::write(std::uint32_t number, JobRecord& job, const std::string& name,
                             Report& report) const {
  if (names_.empty()) return ExitCode::done;
  OutputOptions output = options_;
  output.files = files(number);
  return write_output(output, job, name, report);
}

}  // namespace metamer::cli
