#include "client/cli/output.h"

#include <unistd.h>

#include <google/protobuf/text_format.h>
#include <cerrno>
#include <cstring>

#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include "client/cli/development.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const std::string& file) {
  std::string extension = fs::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

/// Why the file can't be written; empty: nothing speaks against it.
std::string objection(const std::string& file, bool factors) {
  const std::string extension = lower_extension(file);
  if (!factors && extension != ".png" && extension != ".exr")
    return "\"" + file + "\" ends neither in .png nor in .exr";
  std::error_code error;
  if (fs::is_directory(file, error)) return "\"" + file + "\" is a folder";
  const fs::path folder = fs::path(file).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error))
    return "there is no folder \"" + folder.string() + "\"";
  if (access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
    return "the folder of \"" + file + "\" can't be written: " + std::strerror(errno);
  return {};
}

std::map<std::string, std::string> metadata(const Followed& followed, const std::string& name) {
  std::map<std::string, std::string> values = {{"metamer:version", METAMER_VERSION},
                                               {"metamer:scene", name}};
  google::protobuf::TextFormat::PrintToString(*followed.plan, &values["metamer:plan"]);
  google::protobuf::TextFormat::PrintToString(followed.last.finished().timing(),
                                              &values["metamer:timing"]);
  return values;
}

std::string counted_pixels(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " pixel" : " pixels");
}

void note_gamut(const std::string& file, const std::string& space, const GamutReport& gamut,
                Report& report) {
  Problem note;
  note.file = file;
  if (gamut.negative > 0) {
    note.message = counted_pixels(gamut.negative) + " outside the " + space + " gamut, clipped";
    report.note(note);
  }
  if (gamut.above > 0) {
    note.message = counted_pixels(gamut.above) + " brighter than white, clipped";
    report.note(note);
  }
}

/// Where the factors go.
fs::path factors_file(const OutputOptions& options) {
  return options.factors->empty() ? fs::path(options.files.front()).replace_extension(".factors")
                                  : fs::path(*options.factors);
}

/// The factors of a job that keeps them.
ExitCode write_kept_factors(const OutputOptions& options, Followed& followed, Report& report) {
  const fs::path file = factors_file(options);
  if (!followed.factors) {
    report.error("--keep-factors: the job keeps no factors; submit it with --keep-factors");
    return ExitCode::bad_input;
  }
  if (const auto written = write_factors(followed.factors->finish(), file); !written) {
    report.problem(written.error(), {});
    return ExitCode::other;
  }
  report.document()["files"].push_back(file.string());
  report.line(file.string());
  return ExitCode::done;
}

}  // namespace

bool check_output(const OutputOptions& options, Report& report) {
  bool good = true;
  std::set<std::string> seen;
  std::vector<std::string> files = options.files;
  if (options.factors) files.push_back(factors_file(options).string());
  for (const std::string& file : files) {
    std::string wrong = objection(file, options.factors && &file == &files.back());
    if (wrong.empty() && !seen.insert(fs::path(file).lexically_normal().string()).second)
      wrong = "\"" + file + "\" is named twice";
    if (!wrong.empty()) report.error("--output: " + wrong);
    good = good && wrong.empty();
  }
  if (options.exr != "rgb" && options.exr != "xyz") {
    report.error("--exr: \"" + options.exr + "\" is neither rgb nor xyz");
    good = false;
  }
  return good;
}

Wanted wanted(const OutputOptions& options) {
  return options.factors ? Wanted::tiles_and_factors : Wanted::tiles;
}

ExitCode write_output(const OutputOptions& options, Followed& followed, const std::string& name,
                      Report& report) {
  const auto planned = planned_developing(*followed.plan);
  if (!planned) {
    report.error("the server planned no colour space: " + planned.error().message);
    return ExitCode::other;
  }
  if (!planned->unadapted.empty())
    report.note({.field = {}, .file = {}, .message = "not adapted: " + planned->unadapted});
  const auto values = metadata(followed, name);
  ExitCode code = ExitCode::done;
  for (const std::string& file : options.files) {
    const bool png = lower_extension(file) == ".png";
    const Result<GamutReport> gamut = write_image(
        followed.film->image(), file, !png && options.exr == "xyz", values, planned->developing);
    if (!gamut) {
      report.problem(gamut.error(), {});
      code = ExitCode::other;
      continue;
    }
    if (png) note_gamut(file, planned->developing.space.name, *gamut, report);
    report.document()["files"].push_back(file);
    report.line(file);
  }
  if (options.factors && code == ExitCode::done)
    code = write_kept_factors(options, followed, report);
  return code;
}

}  // namespace metamer::cli
