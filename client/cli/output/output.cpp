#include "client/cli/output/output.h"

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "client/cli/output/pictures.h"

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;

/// Where the factors go.
fs::path factors_file(const OutputOptions& options) {
  return options.factors->empty() ? fs::path(options.files.front()).replace_extension(".factors")
                                  : fs::path(*options.factors);
}

/// Some of the files hold spectra.
bool wants_spectra(const OutputOptions& options) {
  const auto exr = exr_content(options);
  return exr && exr->spectral &&
         std::any_of(options.files.begin(), options.files.end(), client::is_exr);
}

ExitCode write_kept_factors(const OutputOptions& options, const Factors& factors, Report& report) {
  const fs::path file = factors_file(options);
  if (const auto written = write_factors(factors, file); !written) {
    report.problem(written.error(), {});
    return ExitCode::other;
  }
  report.document()["files"].push_back(file.string());
  report.line(file.string());
  return ExitCode::done;
}

}  // namespace

ExitCode check_output(const OutputOptions& options, Report& report) {
  bool good = true;
  std::set<std::string> seen;
  std::vector<std::string> files = options.files;
  if (options.factors) files.push_back(factors_file(options).string());
  for (const std::string& file : files) {
    const bool factors = options.factors && &file == &files.back();
    std::string wrong = client::objection(
        file, factors ? client::FileContent::factors : client::FileContent::picture);
    if (wrong.empty() && !seen.insert(fs::path(file).lexically_normal().string()).second)
      wrong = "\"" + file + "\" is named twice";
    if (!wrong.empty()) report.error("--output: " + wrong);
    good = good && wrong.empty();
  }
  if (const auto exr = exr_content(options); !exr) {
    report.error("--exr: " + exr.error().message);
    good = false;
  }
  return good ? ExitCode::done : ExitCode::bad_input;
}

JobParts wanted(const OutputOptions& options) {
  return options.factors || wants_spectra(options) ? JobParts::picture_and_factors
                                                   : JobParts::picture;
}

ExitCode write_output(const OutputOptions& options, JobRecord& job, const std::string& name,
                      Report& report) {
  std::map<std::string, std::string> metadata = {{"metamer:scene", name}};
  google::protobuf::TextFormat::PrintToString(job.last.finished().timing(),
                                              &metadata["metamer:timing"]);
  if (job.last.finished().has_accuracy())
    google::protobuf::TextFormat::PrintToString(job.last.finished().accuracy(),
                                                &metadata["metamer:accuracy"]);
  std::optional<Factors> factors;
  if (job.factors) factors = job.factors->finish();
  const bool missing = !factors && wanted(options) == JobParts::picture_and_factors;
  if (missing && !job.factors_lost) {
    report.error("the job keeps no factors, which " +
                 std::string(options.factors ? "--keep-factors" : "--exr spectral") +
                 " needs: submit it with --keep-factors");
    return ExitCode::bad_input;
  }
  if (missing)
    report.error(
        "the picture has more factors than are kept (glass, and mirrors that face each other, make "
        "many): lower --depth or --tile-size");
  const ExitCode code = write_pictures(options,
                                       {job.film->image(), *job.plan, factors ? &*factors : nullptr,
                                        factors ? &factors->scene : nullptr, std::move(metadata)},
                                       report);
  if (missing) return ExitCode::other;
  if (!options.factors || code != ExitCode::done) return code;
  return write_kept_factors(options, *factors, report);
}

}  // namespace metamer::cli
