#include "client/cli/pictures.h"

#include <google/protobuf/text_format.h>

#include <cctype>
#include <cmath>
#include <filesystem>

#include "client/cli/development.h"
#include "client/cli/spectra_input.h"
#include "client/relight/relight.h"
#include "common/image/spectral_exr.h"
#include "common/scene/settings.h"

namespace metamer::cli {
namespace {

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

Result<void> write_spectra_of(const Pictures& pictures, const Wavelengths& wavelengths,
                              const std::string& file,
                              const std::map<std::string, std::string>& metadata) {
  const std::size_t values = wavelengths.size() * pictures.xyz.pixels.size() / 3;
  if (values > max_image_values)
    return tl::unexpected(Problem{.field = {},
                                  .file = file,
                                  .message = "a spectral picture of " + std::to_string(values) +
                                             " values is over the limit of " +
                                             std::to_string(max_image_values) +
                                             ": fewer wavelengths, or a smaller one"});
  Image bands = relight_spectral(*pictures.factors, *pictures.scene,
                                 to_observer(pictures.plan.observer()), wavelengths);
  return write_spectral_exr({.width = bands.width,
                             .height = bands.height,
                             .reflectance = false,
                             .nm = wavelengths.nm(),
                             .values = std::move(bands.pixels),
                             .units = {},
                             .polarised = false},
                            pictures.xyz, file, metadata);
}

/// Says what a spectral file does not have in common with the others.
void note_spectra(const std::string& file, const Pictures& pictures, const Wavelengths& wavelengths,
                  Report& report) {
  const auto note = [&](std::string message) {
    report.note({.field = {}, .file = file, .message = std::move(message)});
  };
  if (!pictures.plan.method().has_exact())
    note("its spectra are those of the exact method, whatever the other files are rendered by");
  constexpr double unnoticed = 0.02;
  for (const v1::SceneFactors::Light& light : pictures.scene->light()) {
    const double share = seen_share(light, to_observer(pictures.plan.observer()), wavelengths);
    if (std::abs(share - 1) > unnoticed)
      note("its wavelengths see " + number_text(std::round(share * 1000) / 10) +
           " % of the luminance of light " + quoted(light.name()));
  }
}

}  // namespace

std::string lower_extension(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool is_exr(const std::string& file) { return lower_extension(file) == ".exr"; }

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
  const auto planned = planned_developing(pictures.plan);
  if (!planned) {
    report.error("the server planned no colour space: " + planned.error().message);
    return ExitCode::other;
  }
  if (!planned->unadapted.empty())
    report.note({.field = {}, .file = {}, .message = "not adapted: " + planned->unadapted});
  auto metadata = pictures.metadata;
  metadata["metamer:version"] = METAMER_VERSION;
  google::protobuf::TextFormat::PrintToString(pictures.plan, &metadata["metamer:plan"]);

  const ExrContent exr = *exr_content(options);
  ExitCode code = ExitCode::done;
  for (const std::string& file : options.files) {
    const bool png = !is_exr(file);
    if (!png && exr.spectral && !pictures.factors) continue;  // why, was said
    Result<GamutReport> gamut;
    if (!png && exr.spectral)
      gamut = write_spectra_of(pictures, *exr.spectral, file, metadata).map([] {
        return GamutReport{};
      });
    else
      gamut = write_image(pictures.xyz, file, !png && exr.xyz, metadata, planned->developing);
    if (!gamut) {
      report.problem(gamut.error(), {});
      code = ExitCode::other;
      continue;
    }
    if (!png && exr.spectral) note_spectra(file, pictures, *exr.spectral, report);
    if (png) note_gamut(file, planned->developing.space.name, *gamut, report);
    report.document()["files"].push_back(file);
    report.line(file);
  }
  return code;
}

}  // namespace metamer::cli
