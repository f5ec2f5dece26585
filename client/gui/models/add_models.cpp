#include "client/gui/models/add_models.h"

#include "client/gui/models/models_page.h"

namespace metamer::gui {

void add_models(MainWindow& window) {
  window.actions().bind(QStringLiteral("help.models"), [&window] {
    auto* page = window.findChild<ModelsPage*>();
    if (page == nullptr) page = new ModelsPage;
    window.show_picture(page, ModelsPage::tr("Models"));
  });
}

}  // namespace metamer::gui
