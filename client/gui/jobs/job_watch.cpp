#include "client/gui/jobs/job_watch.h"

#include <chrono>
#include <optional>
#include <utility>

#include "client/tools/pictures/planned_developing.h"
#include "client/tools/pictures/reduced.h"
#include "client/tools/pictures/screen_pixels.h"

namespace metamer::gui {
namespace {

constexpr qint64 most_grown = qint64{4} << 20;  ///< Pixels.

/// The tiles that have not gone to the window yet. Of the session's thread.
class Growth {
 public:
  using Clock = std::chrono::steady_clock;

  void begin(const v1::Plan& plan) {
    developed_.clear();
    // A space that there can't be is told when the picture is written; none is shown.
    const Result<client::PlannedDeveloping> planned = client::planned_developing(plan);
    pixels_.reset();
    if (planned) pixels_.emplace(planned->developing);
    const QSize size(static_cast<int>(plan.width()), static_cast<int>(plan.height()));
    side_ = growth_side(size);
  }

  void add(const v1::Tile& tile) {
    const std::size_t pixels = std::size_t{tile.width()} * tile.height();
    // Film::add refuses the others, and ends the watch.
    if (!pixels_ || pixels == 0 || pixels > largest ||
        tile.xyz().size() != pixels * 3 * sizeof(float))
      return;
    const int width = static_cast<int>(tile.width()), height = static_cast<int>(tile.height());
    Image xyz = make_image(width, height, {"X", "Y", "Z"});
    std::memcpy(xyz.pixels.data(), tile.xyz().data(), tile.xyz().size());
    if (side_ > 1) xyz = client::reduced(xyz, {0, 0, width, height}, side_);
    QImage image(xyz.width, xyz.height, QImage::Format_RGB32);
    for (int y = 0; y < image.height(); ++y)
      pixels_->develop(
          xyz.at(0, y), static_cast<std::size_t>(xyz.width), 1,
          reinterpret_cast<std::uint32_t*>(image.scanLine(y)));  // what RGB32 is made of
    const QPoint corner(static_cast<int>(tile.x()), static_cast<int>(tile.y()));
    developed_ << ShownTile{corner / side_, image};
  }

  /// Whether the window is to have them now.
  bool due() const { return !developed_.isEmpty() && Clock::now() - given_ >= interval; }
  QList<ShownTile> take() {
    given_ = Clock::now();
    return std::exchange(developed_, {});
  }

 private:
  static constexpr std::chrono::milliseconds interval{33};
  static constexpr std::size_t largest = std::size_t{256} * 256;  ///< limits::max_tile

  std::optional<client::ScreenPixels> pixels_;
  int side_ = 1;
  QList<ShownTile> developed_;
  Clock::time_point given_{};
};

}  // namespace

int growth_side(const QSize& picture) {
  int side = 1;
  while (qint64{picture.width()} * picture.height() > most_grown * side * side) side *= 2;
  return side;
}

QSize grown_size(const QSize& picture) {
  const int side = growth_side(picture);
  return {(picture.width() + side - 1) / side, (picture.height() + side - 1) / side};
}

JobWatch::JobWatch(Link& link, client::JobHandle job, client::JobParts parts, QObject* parent)
    : QObject(parent) {
  const QPointer<QObject> self(this);
  const auto growth = std::make_shared<Growth>();
  const auto give = [this, &link, self, growth] {
    if (QList<ShownTile> tiles = growth->take(); !tiles.isEmpty())
      link.deliver(self, [this, tiles = std::move(tiles)] { Q_EMIT grew(tiles); });
  };
  const auto on_event = [this, &link, self, growth, give](const v1::JobEvent& event) {
    if (event.has_preview()) return;
    if (event.has_tile()) {
      growth->add(event.tile());
      if (growth->due()) give();
      return;
    }
    give();
    if (event.has_planned()) growth->begin(event.planned().plan());
    link.deliver(self, [this, kept = std::make_shared<const v1::JobEvent>(event)] {
      Q_EMIT this->event(kept);
    });
  };
  const auto done = [this, &link, self, give](client::Answer<client::JobRecord> came) {
    give();
    if (came)
      link.deliver(self, [this, kept = std::make_shared<client::JobRecord>(std::move(*came))] {
        Q_EMIT ended(kept);
      });
    else
      link.deliver(self, [this, kept = std::make_shared<const client::SessionError>(came.error())] {
        Q_EMIT lost(kept);
      });
  };
  std::stop_source stop;
  connect(this, &QObject::destroyed, this, [stop]() mutable { stop.request_stop(); });
  link.hub().record(std::move(job), parts, stop.get_token(), on_event, done);
}

}  // namespace metamer::gui
