#include "client/gui/looks/rgb_map.h"

#include <memory>

#include "client/gui/compare/add_compare.h"

namespace metamer::gui {

RgbMap::RgbMap(MainWindow& window) : QObject(&window), window_(window) {
  window.actions().bind(QStringLiteral("light.rgb_map"), [this] { start(); });
}

void RgbMap::start() {
  LivePage* live = window_.live();
  if (live == nullptr || !live->frame()) return;
  window_.say(tr("comparing the live picture with what three numbers make of it …"));
  live->show_by(std::nullopt);
  live->hand_over([self = QPointer<RgbMap>(this), live = QPointer<LivePage>(live),
                   number = ++asked_](const Picture& own) {
    if (self != nullptr && live != nullptr && number == self->asked_)
      self->compare_with(own, live, number);
  });
}

void RgbMap::compare_with(const Picture& own, LivePage* live, unsigned number) {
  v1::Method method;
  method.mutable_rgb();
  live->show_by(method);
  // The picture that is handed over first may still be the one before.
  const auto first = std::make_shared<QMetaObject::Connection>();
  *first = connect(live, &LivePage::framed, this, [this, own, live, number, first] {
    if (!live->frame()->plan.method().has_rgb()) return;
    disconnect(*first);
    live->hand_over([this, own, live, number](const Picture& rgb) {
      if (number != asked_) return;
      live->show_by(std::nullopt);
      Picture named = rgb;
      named.title = tr("%1, by R, G, B").arg(rgb.title);
      compare_pictures(window_, own, named);
    });
  });
}

}  // namespace metamer::gui
