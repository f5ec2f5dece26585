#include "client/gui/methods/add_methods.h"

#include "client/gui/jobs/render_scene.h"
#include "client/gui/methods/methods_room.h"

namespace metamer::gui {

void add_methods(MainWindow& window) {
  auto* room = new MethodsRoom(window);
  window.actions().bind(QStringLiteral("render.explain"),
                        [&window, room] { when_checked(window, [room] { room->explain(); }); });
  window.actions().bind(QStringLiteral("render.measure"), [&window, room] {
    when_checked(window, [room] { room->measure(room->dock().chosen_rounds()); });
  });
}

}  // namespace metamer::gui
