#include "client/cli/commands/series/series_sheet.h"

#include <algorithm>

#include "client/tools/pictures/planned_developing.h"
#include "common/color/matrix3.h"

namespace metamer::cli {
namespace {

/// More nobody looks at, and a sheet of them is 3,700 pixels wide.
constexpr std::uint32_t most_cells = 100;

}  // namespace

SeriesSheet::SeriesSheet(std::string file, std::uint32_t count)
    : file_(std::move(file)),
      every_(std::max(1u, (count + most_cells - 1) / most_cells)),
      cells_((count + every_ - 1) / every_) {}

void SeriesSheet::note(std::uint32_t index, const std::string& words) {
  if (!file_.empty() && index % every_ == 0) cells_[index / every_].note = words;
}

void SeriesSheet::add(std::uint32_t index, const std::string& label, const client::JobRecord* job) {
  if (file_.empty() || index % every_ != 0) return;
  client::SheetCell& cell = cells_[index / every_];
  cell.title = label;
  if (job == nullptr || !job->film || !job->plan) return;
  Image picture = job->film->image();
  if (const auto planned = client::planned_developing(*job->plan)) {
    developing_ = planned->developing;
    picture = client::adapted(std::move(picture), developing_);
  }
  cell.picture = client::for_sheet(picture);
}

ExitCode SeriesSheet::write(Report& report) {
  if (file_.empty()) return ExitCode::done;
  const auto written = client::picture_grid(std::move(cells_)).and_then([&](const Image& image) {
    Developing developing = developing_;
    developing.adaptation = identity3;  // each picture has its own
    return write_image(image, file_, false, {}, developing);
  });
  if (!written) return report.problem(written.error(), {}), ExitCode::other;
  report.document()["files"].push_back(file_);
  report.line(file_);
  return ExitCode::done;
}

}  // namespace metamer::cli
