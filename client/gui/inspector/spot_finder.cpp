#include "client/gui/inspector/spot_finder.h"

#include <utility>

#include "client/gui/app/on_pool.h"
#include "client/relight/relight.h"
#include "client/tools/pictures/pixel_material.h"
#include "client/tools/pictures/pixel_spectrum.h"
#include "client/tools/pictures/planned_developing.h"

namespace metamer::gui {
namespace {

/// What looks white: the dominant light, which is the scene's first.
QString white_name(const v1::Scene& scene) {
  if (scene.light().empty()) return {};
  const v1::Light& first = scene.light(0);
  const QString name = QString::fromStdString(first.name());
  if (first.spectrum().standard().empty()) return name;
  return QStringLiteral("%1, %2").arg(QString::fromStdString(first.spectrum().standard()), name);
}

/// What factors say of a place: `probed` with what reaches the eye, material and object.
v1::Probed probed_factors(const Picture& picture, const QPoint& at, int side) {
  const client::Factors& factors = *picture.factors;
  const std::vector<double> eye = client::pixel_spectrum(
      factors, picture.relit ? *picture.relit : factors.scene,
      client::observer_of(*picture.plan, factors.scene), at.x(), at.y(), side);
  v1::Probed probed;
  probed.mutable_eye()->Add(eye.begin(), eye.end());
  const auto material = client::pixel_material(factors, at.x(), at.y());
  if (!material) return probed;
  probed.set_material(*material);
  // Factors know no objects: it is this one where no other has the material.
  const auto objects =
      picture.scene ? client::objects_of(*picture.scene, *material) : std::vector<std::string>{};
  if (objects.size() == 1) probed.set_object(objects.front());
  return probed;
}

std::optional<client::PixelReading> reading_of(const Xyz& xyz, const v1::Plan& plan) {
  std::optional<Xyz> white;
  if (plan.source_white_size() == 3)
    white = Xyz{plan.source_white(0), plan.source_white(1), plan.source_white(2)};
  const auto planned = client::planned_developing(plan);
  return client::read_color(xyz, white, planned ? planned->developing : Developing{});
}

}  // namespace

SpotFinder::SpotFinder(MainWindow& window, Inspector& inspector)
    : QObject(&window), window_(window), inspector_(inspector) {
  connect(&window.pictures(), &QTabWidget::currentChanged, this, &SpotFinder::follow_page);
  connect(&inspector, &Inspector::side_changed, this, &SpotFinder::look_again);
  connect(&inspector, &Inspector::pins_changed, this, &SpotFinder::show_marks);
  connect(&inspector, &Inspector::object_clicked, this, &SpotFinder::go_to_object);
  connect(&window.link(), &Link::unknown_changed, this, &SpotFinder::show_whether_known);
  follow_page();
}

/// Of pictures that are complete all is known here.
void SpotFinder::show_whether_known() {
  const QString why =
      live() == nullptr ? QString() : window_.link().unknown(QStringLiteral("Probe"));
  window_.actions().forbid(QStringLiteral("light.pin"), why);
  inspector_.show_missing(why);
}

LivePage* SpotFinder::live() const { return qobject_cast<LivePage*>(page_.data()); }

void SpotFinder::follow_page() {
  if (page_ != nullptr) {
    page_->disconnect(this);
    page_->canvas().disconnect(this);
  }
  if (document_ != nullptr) document_->disconnect(this);
  page_ = window_.picture_page();
  document_ = live() == nullptr ? nullptr : &live()->document();
  pixel_.reset();
  show_whether_known();
  if (page_ == nullptr) return;
  connect(&page_->canvas(), &Canvas::hovered, this, &SpotFinder::hover);
  if (live() == nullptr) return;
  connect(document_, &Document::look_changed, this, &SpotFinder::show_marks);
  connect(document_, &Document::camera_changed, this, &SpotFinder::show_marks);
  connect(live(), &LivePage::framed, this, [this] {
    if (live()->frame()->frame.complete()) look_again();
  });
  connect(live(), &LivePage::probed, this,
          [this](const auto& place, const auto& probed) { take(place, *probed); });
  connect(live(), &LivePage::not_probed, this, [this](const auto& error) {
    if (error->code == v1::Error::UNKNOWN_MESSAGE)
      window_.link().note_unknown(QStringLiteral("Probe"));
    else
      inspector_.show_missing(QString::fromStdString(error->message));
  });
  show_marks();
}

/// Where the cursor leaves the picture, its last place stays.
void SpotFinder::hover(const std::optional<QPoint>& pixel) {
  if (!pixel) return;
  pixel_ = pixel;
  look_again();
}

void SpotFinder::look_again() {
  if (page_ == nullptr || !pixel_ || !inspector_.isVisible()) return;
  if (live() != nullptr && !window_.link().unknown(QStringLiteral("Probe")).isEmpty()) return;
  if (live() != nullptr)
    live()->probe(*pixel_, inspector_.side());
  else if (const auto picture = page_->picture())
    look_at(*picture);
}

void SpotFinder::take(const client::ViewPlace& place, const v1::Probed& probed) {
  const auto frame = live()->frame();
  if (!frame) return;
  Spot spot{.from = live()->document().title(),
            .pixel = {static_cast<int>(place.x), static_cast<int>(place.y)},
            .side = static_cast<int>(place.side),
            .color = {},
            .white = {},
            .probed = probed};
  if (probed.xyz_size() == 3)
    spot.color = reading_of({probed.xyz(0), probed.xyz(1), probed.xyz(2)}, frame->plan);
  if (const auto scene = live()->document().effective()) spot.white = white_name(*scene);
  size_ = {static_cast<int>(frame->plan.width()), static_cast<int>(frame->plan.height())};
  inspector_.show_spot(spot);
}

void SpotFinder::look_at(const Picture& picture) {
  if (!pixel_ || pixel_->x() >= picture.xyz->width || pixel_->y() >= picture.xyz->height) return;
  const int side = inspector_.side();
  Spot spot{.from = picture.name(),
            .pixel = *pixel_,
            .side = side,
            .color = reading_of(client::mean_xyz(*picture.xyz, pixel_->x(), pixel_->y(), side),
                                picture.plan ? *picture.plan : v1::Plan()),
            .white = picture.scene ? white_name(*picture.scene) : QString(),
            .probed = {}};
  if (side > 1) spot.spread = client::spread_xyz(*picture.xyz, pixel_->x(), pixel_->y(), side);
  size_ = {picture.xyz->width, picture.xyz->height};
  inspector_.show_spot(spot);
  if (!picture.factors)
    return inspector_.show_missing(
        tr("Its factors were not kept: of its places X Y Z alone are known."));
  const auto work = [picture, at = *pixel_, side] { return probed_factors(picture, at, side); };
  const unsigned number = ++asked_;
  on_pool(this, work, [this, spot, number](const v1::Probed& probed) {
    if (number != asked_) return;
    Spot known = spot;
    known.probed = probed;
    inspector_.show_spot(known);
  });
}

void SpotFinder::pin() {
  if (page_ == nullptr || !inspector_.spot() || !inspector_.pin()) return;
  const Pin& pin = inspector_.pins().pins().back();
  marks_ << Mark{
      .pin = pin.number,
      .page = page_,
      .place = {(pin.spot.pixel.x() + 0.5) / size_.width(),
                (pin.spot.pixel.y() + 0.5) / size_.height()},
      .camera = live() == nullptr ? std::string() : live()->camera().SerializeAsString()};
  show_marks();
}

void SpotFinder::show_marks() {
  if (page_ == nullptr) return;
  const std::string camera =
      live() == nullptr || marks_.isEmpty() ? std::string() : live()->camera().SerializeAsString();
  QList<CanvasMark> shown;
  for (const Pin& pin : inspector_.pins().pins())
    for (const Mark& mark : marks_)
      if (mark.pin == pin.number && mark.page == page_ && mark.camera == camera)
        shown << CanvasMark{mark.place, QString::number(pin.number)};
  page_->canvas().set_marks(shown);
}

/// In the text of the scene that the picture is of.
void SpotFinder::go_to_object(const QString& name) {
  auto* document = page_ == nullptr ? nullptr : qobject_cast<Document*>(page_->subject());
  if (document == nullptr || !document->sound()) return;
  const v1::Scene& scene = document->sound()->scene();
  QString field = name;  // of one without a name: its place
  for (int i = 0; i < scene.object_size(); ++i)
    if (scene.object(i).name() == name.toStdString()) field = QStringLiteral("object[%1]").arg(i);
  Problem place;
  place.field = field.toStdString();
  place = document->sound()->locate(std::move(place));
  SceneEditor* editor = window_.show_text(document);
  if (place.line > 0 && editor != nullptr) editor->go_to(place.line, place.column);
}

}  // namespace metamer::gui
