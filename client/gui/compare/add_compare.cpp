#include "client/gui/compare/add_compare.h"

#include <QDropEvent>
#include <QPointer>

#include "client/gui/compare/compare_page.h"

namespace metamer::gui {
namespace {

QList<PictureAtHand> pictures_at_hand(MainWindow& window) {
  QList<PictureAtHand> found;
  for (int i = 0; i < window.pictures().count(); ++i) {
    auto* page = qobject_cast<PicturePage*>(window.pictures().widget(i));
    if (page == nullptr || page->picture_title().isEmpty()) continue;
    found << PictureAtHand{page->picture_title(), [page = QPointer<PicturePage>(page)](auto to) {
                             if (page) page->hand_over(std::move(to));
                           }};
  }
  return found;
}

ComparePage* make_compare(MainWindow& window) {
  auto* page = new ComparePage([&window] { return pictures_at_hand(window); });
  const auto show_state = [&window, page] {
    window.actions()[QStringLiteral("view.wipe")]->setChecked(page->side() ==
                                                              ComparePage::Side::wipe);
  };
  QObject::connect(page, &ComparePage::side_changed, &window, show_state);
  QObject::connect(page, &ComparePage::shown, &window, [&window, page] {
    if (const auto comparison = page->comparison())
      for (const QString& note : comparison->notes)
        window.log().write(LogKind::warning, ComparePage::tr("Compare"), note);
  });
  show_state();
  return page;
}

ComparePage& show_compare(MainWindow& window) {
  auto* page = window.findChild<ComparePage*>();
  if (page == nullptr) page = make_compare(window);
  window.show_picture(page, ComparePage::tr("Compare"));
  return *page;
}

/// To begin with, the newest two complete pictures where they are of one size, else the newest.
void fill(ComparePage& page, const QTabWidget& tabs) {
  if (page.slot_box(0).source() || page.slot_box(1).source()) return;
  QList<Picture> complete;
  for (int i = 0; i < tabs.count(); ++i)
    if (const auto* one = qobject_cast<const PicturePage*>(tabs.widget(i)))
      if (const auto picture = one->picture()) complete << *picture;
  if (complete.isEmpty()) return;
  const auto size = [](const Picture& one) { return QSize(one.xyz->width, one.xyz->height); };
  const Picture newest = complete.takeLast();
  const bool pair = !complete.isEmpty() && size(complete.back()) == size(newest);
  if (pair) page.slot_box(0).set_source({{}, complete.back()});
  page.slot_box(pair ? 1 : 0).set_source({{}, newest});
}

/// A file that is dropped onto a picture is compared with it.
class PictureDrops : public QObject {
 public:
  explicit PictureDrops(MainWindow& window) : QObject(&window), window_(window) {
    window.pictures().setAcceptDrops(true);
    window.pictures().installEventFilter(this);
  }

  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop) return false;
    auto& drop = static_cast<QDropEvent&>(*event);
    const QString file = dragged_picture(*drop.mimeData());
    if (file.isEmpty()) return false;
    drop.acceptProposedAction();
    if (event->type() == QEvent::Drop) compare(file);
    return true;
  }

 private:
  void compare(const QString& file) {
    PicturePage* front = window_.picture_page();
    ComparePage& page = show_compare(window_);
    if (front == &page || front == nullptr || front->picture_title().isEmpty())
      return page.add({file});
    page.slot_box(0).set_at_hand(
        {front->picture_title(), [front](auto to) { front->hand_over(std::move(to)); }});
    page.slot_box(1).set_source({file});
  }

  MainWindow& window_;
};

}  // namespace

void compare_pictures(MainWindow& window, const Picture& a, const Picture& b) {
  ComparePage& page = show_compare(window);
  page.slot_box(0).set_source({{}, a});
  page.slot_box(1).set_source({{}, b});
}

void add_compare(MainWindow& window) {
  window.actions().bind(QStringLiteral("compare.pictures"),
                        [&window] { fill(show_compare(window), window.pictures()); });
  window.actions().bind_toggle(QStringLiteral("view.wipe"), [&window](bool wiped) {
    if (auto* page = qobject_cast<ComparePage*>(window.picture_page()))
      page->show_side(wiped ? ComparePage::Side::wipe : ComparePage::Side::a);
  });
  new PictureDrops(window);
}

}  // namespace metamer::gui
