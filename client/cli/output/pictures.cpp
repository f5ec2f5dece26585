#include "client/cli/output/pictures.h"

#include <algorithm>
#include <cmath>

#include "client/cli/commands/spectra/spectra_input.h"

namespace metamer::cli {
namespace {

using client::ExrContent;
using client::Pictures;
using client::SavedPicture;

std::string counted_pixels(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " pixel" : " pixels");
}

/// Says what a .png had to clip, and what a spectral file does not have in common with the others.
void note_saved(const std::string& file, const SavedPicture& saved, const Pictures& pictures,
                const std::string& space, Report& report) {
  const auto note = [&](std::string message) {
    report.note({.field = {}, .file = file, .message = std::move(message)});
  };
  if (saved.spectral && !pictures.plan.method().has_exact())
    note("its spectra are those of the exact method, whatever the other files are rendered by");
  for (const client::SeenLight& one : saved.mis_seen)
    note("its wavelengths see " + number_text(std::round(one.share * 1000) / 10) +
         " % of the luminance of light " + quoted(one.light));
  if (saved.clipped.negative > 0)
    note(counted_pixels(saved.clipped.negative) + " outside the " + space + " gamut, clipped");
  if (saved.clipped.above > 0)
    note(counted_pixels(saved.clipped.above) + " brighter than white, clipped");
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
  auto planned = client::planned_developing(pictures.plan);
  if (!planned) {
    report.error("the server planned no colour space: " + planned.error().message);
    return ExitCode::other;
  }
  planned->developing.bits = options.png == "16" ? 16 : 8;
  if (!planned->unadapted.empty())
    report.note({.field = {}, .file = {}, .message = "not adapted: " + planned->unadapted});
  const ExrContent exr = *exr_content(options);
  const bool has_rgb = std::any_of(
      options.files.begin(), options.files.end(),
      [&](const std::string& file) { return !client::is_exr(file) || !(exr.xyz || exr.spectral); });
  if (has_rgb && !planned->shown_white.empty())
    report.note({.field = {}, .file = {}, .message = planned->shown_white});
  ExitCode code = ExitCode::done;
  for (const std::string& file : options.files) {
    if (client::is_exr(file) && exr.spectral && !pictures.factors) continue;  // why, was said
    const auto saved = client::save_picture(pictures, file, exr, *planned);
    if (!saved) {
      report.problem(saved.error(), {});
      code = ExitCode::other;
      continue;
    }
    note_saved(file, *saved, pictures, planned->developing.space.name, report);
    report.document()["files"].push_back(file);
    report.line(file);
  }
  return code;
}

}  // namespace metamer::cli
