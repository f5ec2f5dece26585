#include "client/gui/app/rooms.h"

#include "client/gui/app/add_app.h"
#include "client/gui/app/link_bar.h"
#include "client/gui/compare/add_compare.h"
#include "client/gui/files/add_files.h"
#include "client/gui/forms/add_forms.h"
#include "client/gui/inspector/add_inspector.h"
#include "client/gui/jobs/add_jobs.h"
#include "client/gui/live/add_live.h"
#include "client/gui/log/add_log.h"
#include "client/gui/looks/add_looks.h"
#include "client/gui/methods/add_methods.h"
#include "client/gui/models/add_models.h"
#include "client/gui/picture/add_picture.h"
#include "client/gui/problems/add_problems.h"
#include "client/gui/sheet/add_sheet.h"
#include "client/gui/spectra/add_spectra.h"

namespace metamer::gui {

void add_rooms(MainWindow& window) {
  add_app(window);
  add_files(window);
  add_link_bar(window);
  add_live(window);
  add_jobs(window);
  add_forms(window);
  add_compare(window);
  add_models(window);
  add_spectra(window);
  add_problems(window);
  add_looks(window);
  add_picture(window);
  add_inspector(window);
  add_sheet(window);
  add_methods(window);
  add_log(window);
}

}  // namespace metamer::gui
