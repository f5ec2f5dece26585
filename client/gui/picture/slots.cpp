#include "client/gui/picture/slots.h"

namespace metamer::gui {

void flick(MainWindow& window, int by) {
  PicturePage* front = window.picture_page();
  if (front == nullptr) return;
  QList<PicturePage*> pages;
  for (int i = 0; i < window.pictures().count(); ++i)
    if (auto* page = qobject_cast<PicturePage*>(window.pictures().widget(i));
        page != nullptr && page->canvas().layer() != nullptr &&
        (page == front || (page->subject() != nullptr && page->subject() == front->subject())))
      pages << page;
  const qsizetype at = pages.indexOf(front), count = pages.size();
  if (at < 0 || count < 2)
    return window.say(MainWindow::tr("there is no other picture of this scene yet"));
  const qsizetype next = (at + by + count) % count;
  PicturePage& page = *pages[next];
  if (page.canvas().picture_size() == front->canvas().picture_size())
    page.canvas().set_view(front->canvas().view());
  window.pictures().setCurrentWidget(&page);
  page.setFocus();
  window.say(MainWindow::tr("slot %1 of %2: %3")
                 .arg(next + 1)
                 .arg(count)
                 .arg(window.pictures().tabText(window.pictures().currentIndex())));
}

}  // namespace metamer::gui
