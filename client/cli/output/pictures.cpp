#include "client/cli/output/pictures.h"

#include <algorithm>

#include "client/cli/commands/spectra/spectra_input.h"
#include "client/tools/text/saved_text.h"

namespace metamer::cli {
namespace {

using client::ExrContent;
using client::Pictures;
using client::PlannedDeveloping;
using client::SavedPicture;

/// How the picture becomes numbers; false: it can't, which is said.
bool plan_developing(const OutputOptions& options, client::PictureFiles& one, Report& report) {
  auto planned = client::planned_developing(one.pictures.plan);
  if (!planned)
    return report.error("the server planned no colour space: " + planned.error().message), false;
  one.planned = std::move(*planned);
  one.planned.developing.bits = options.png == "16" ? 16 : 8;
  return true;
}

/// Says what became of a picture's files.
ExitCode report_saved(const client::PictureFiles& one,
                      const std::vector<Result<SavedPicture>>& saved, const ExrContent& exr,
                      Report& report) {
  const PlannedDeveloping& planned = one.planned;
  if (!planned.unadapted.empty())
    report.note({.field = {}, .file = {}, .message = "not adapted: " + planned.unadapted});
  const bool has_rgb = std::any_of(
      one.files.begin(), one.files.end(),
      [&](const std::string& file) { return !client::is_exr(file) || !(exr.xyz || exr.spectral); });
  if (has_rgb && !planned.shown_white.empty())
    report.note({.field = {}, .file = {}, .message = planned.shown_white});
  ExitCode code = ExitCode::done;
  for (std::size_t i = 0; i < saved.size(); ++i) {
    if (!saved[i]) {
      report.problem(saved[i].error(), {});
      code = ExitCode::other;
      continue;
    }
    for (std::string& note : client::saved_notes(*saved[i], one.pictures.plan, planned))
      report.note({.field = {}, .file = one.files[i], .message = std::move(note)});
    report.document()["files"].push_back(one.files[i]);
    report.line(one.files[i]);
  }
  return code;
}

}  // namespace

Result<ExrContent> exr_content(const OutputOptions& options) {
  if (options.exr == "rgb") return ExrContent{};
  if (options.exr == "xyz") return ExrContent{true, {}};
  const std::string word = "spectral";
  if (options.exr == word) return ExrContent{false, *Wavelengths::uniform(380, 780, 5)};
  if (options.exr.rfind(word + ":", 0) == 0)
    return wavelengths_of(options.exr.substr(word.size() + 1), std::nullopt)
        .map([](Wavelengths&& at) {
          return ExrContent{false, std::move(at)};
        });
  return problem("\"" + options.exr +
                 "\" is neither rgb nor xyz nor spectral, nor spectral:FROM:TO:STEP");
}

ExitCode write_pictures(const OutputOptions& options, const Pictures& pictures, Report& report) {
  return write_pictures(options, {{.pictures = pictures, .files = options.files}}, report);
}

ExitCode write_pictures(const OutputOptions& options, std::vector<client::PictureFiles> all,
                        Report& report) {
  const ExrContent exr = *exr_content(options);
  for (client::PictureFiles& one : all) {
    if (!plan_developing(options, one, report)) return ExitCode::other;
    if (exr.spectral && !one.pictures.factors)
      std::erase_if(one.files, client::is_exr);  // was said
  }
  const auto saved = client::save_all(all, exr);
  ExitCode code = ExitCode::done;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const ExitCode one = report_saved(all[i], saved[i], exr, report); one != ExitCode::done)
      code = one;
  return code;
}

}  // namespace metamer::cli
