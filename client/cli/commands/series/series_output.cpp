#include "client/cli/commands/series/series_output.h"

#include <filesystem>
#include <set>

#include "client/tools/pictures/save_pictures.h"

namespace metamer::cli {

std::optional<SeriesOutput> SeriesOutput::read(const OutputOptions& options,
                                               const std::string& option, const std::string& sheet,
                                               const std::vector<std::uint32_t>& numbers,
                                               Report& report) {
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
  checked.files = output.files(numbers.front());
  if (!good || check_output(checked, report) != ExitCode::done) return std::nullopt;
  if (const std::string file = output.named_twice(sheet, numbers); !file.empty()) {
    report.error((file == sheet ? "--sheet" : option) + ": " + quoted(file) + " is named twice");
    return std::nullopt;
  }
  return output;
}

std::string SeriesOutput::named_twice(const std::string& sheet,
                                      const std::vector<std::uint32_t>& numbers) const {
  std::set<std::string> seen;
  const auto is_new = [&](const std::string& file) {
    std::error_code ignored;
    return seen.insert(std::filesystem::absolute(file, ignored).lexically_normal().string()).second;
  };
  for (const std::uint32_t number : numbers)
    for (const std::string& file : files(number))
      if (!is_new(file)) return file;
  return sheet.empty() || is_new(sheet) ? std::string() : sheet;
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
