#include "client/gui/picture/add_picture.h"

#include "client/gui/picture/display.h"
#include "client/gui/picture/picture_bar.h"
#include "client/gui/picture/slots.h"

namespace metamer::gui {

void add_picture(MainWindow& window) {
  auto* bar = new PictureBar(window);
  window.addToolBar(bar);
  new Display(window, *bar);
  window.actions().bind(QStringLiteral("view.next_slot"), [&window] { flick(window, 1); });
  window.actions().bind(QStringLiteral("view.previous_slot"), [&window] { flick(window, -1); });
}

}  // namespace metamer::gui
