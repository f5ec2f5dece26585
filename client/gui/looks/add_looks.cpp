#include "client/gui/looks/add_looks.h"

#include "client/gui/looks/look_bar.h"
#include "client/gui/looks/relighter.h"
#include "client/gui/looks/rgb_hold.h"
#include "client/gui/looks/rgb_map.h"
#include "client/gui/looks/settings_actions.h"
#include "client/gui/looks/spectrum_drop.h"
#include "client/gui/looks/swap_dialog.h"

namespace metamer::gui {
namespace {

void swap(MainWindow& window, Swapped what) {
  if (window.document() == nullptr || !window.document()->sound()) return;
  auto* dialog = new SwapDialog(*window.document(), what, &window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->open();
}

}  // namespace

void add_looks(MainWindow& window) {
  bind_settings(window);
  window.addToolBar(new LookBar(window));
  window.actions().bind(QStringLiteral("light.all"), [&window] { swap(window, Swapped::light); });
  window.actions().bind(QStringLiteral("light.paint"), [&window] { swap(window, Swapped::paint); });
  new Relighter(window);
  new RgbHold(window);
  new RgbMap(window);
  new SpectrumDrop(window);
}

}  // namespace metamer::gui
