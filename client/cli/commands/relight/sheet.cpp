#include "client/cli/commands/relight/sheet.h"

#include "client/tools/pictures/planned_developing.h"
#include "client/tools/text/formatted.h"
#include "common/image/compare.h"

namespace metamer::cli {

using client::formatted;

RelightSheet::RelightSheet(const RelightWork& work, bool maps, Report& report) : report_(report) {
  sheet_.maps = maps;
  sheet_.cells.resize(work.lights.size() * work.materials.size());
  for (const Variant& light : work.lights) sheet_.lights.push_back(light.label);
  for (const Variant& material : work.materials) sheet_.candidates.push_back(material.label);
}

void RelightSheet::add(const RelitPicture& picture) {
  client::SheetCell& cell = sheet_.cells[picture.material * sheet_.lights.size() + picture.light];
  Image shown = picture.image;
  if (const auto planned = client::planned_developing(picture.plan)) {
    developing_ = planned->developing;
    shown = client::adapted(std::move(shown), developing_);
  }
  cell.picture = client::for_sheet(shown);
  if (picture.material == 0)
    reference_ = picture.image;
  else
    add_difference(picture, cell);
}

void RelightSheet::add_difference(const RelitPicture& picture, client::SheetCell& cell) {
  const v1::Plan& plan = picture.plan;
  if (plan.source_white_size() != 3) return;
  const Xyz white = {plan.source_white(0), plan.source_white(1), plan.source_white(2)};
  const auto difference = compare(reference_, picture.image, Metric::de00, white);
  if (!difference) return;
  client::set_difference(*difference, cell);
  if (sheet_.maps) cell.map = client::map_for_sheet(*difference);
  const ErrorStatistics& differing = *cell.difference;
  report_.document()["pictures"].back()["de00"] = {{"mean", differing.mean},
                                                   {"percentile_95", differing.percentile_95},
                                                   {"maximum", differing.maximum},
                                                   {"share", cell.share}};
  report_.line(
      formatted("%s under %s: dE00 mean %.2f, 95 %% %.2f, max %.2f from %s, where it "
                "differs (%.3g %% of it)",
                sheet_.candidates[picture.material].c_str(), sheet_.lights[picture.light].c_str(),
                differing.mean, differing.percentile_95, differing.maximum,
                sheet_.candidates[0].c_str(), 100 * cell.share));
}

ExitCode RelightSheet::write(const std::string& file) {
  const auto written = client::contact_sheet(sheet_).and_then([&](const Image& image) {
    Developing developing = developing_;
    developing.adaptation = identity3;  // each picture has its own
    return write_image(image, file, false, {}, developing);
  });
  if (!written) return report_.problem(written.error(), {}), ExitCode::other;
  report_.document()["files"].push_back(file);
  report_.line(file);
  return ExitCode::done;
}

}  // namespace metamer::cli
