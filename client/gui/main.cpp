// metamer-gui [SCENE…] [--server SERVER]: a window on a render service.
#include <QApplication>
#include <QCommandLineParser>
#include <QElapsedTimer>
#include <QSettings>
#include <QTemporaryDir>
#include <optional>

#include "client/gui/app/add_app.h"
#include "client/gui/app/main_window.h"
#include "client/gui/app/measure.h"
#include "client/gui/app/theme.h"
#include "client/gui/app/tour.h"
#include "client/gui/files/lost_texts.h"
#include "client/gui/files/open_files.h"

namespace {

/// Those that are named, else what was open last, else the demo.
void open_scenes(metamer::gui::MainWindow& window, const QStringList& scenes) {
  for (const QString& scene : scenes) window.open(scene);
  if (!scenes.isEmpty() || metamer::gui::open_last_files(window)) return;
  if (const QString booth = metamer::gui::find_booth(); !booth.isEmpty()) window.open(booth);
}

}  // namespace

int main(int count, char** words) {
  QElapsedTimer since;
  since.start();
  QApplication application(count, words);
  QApplication::setApplicationName(QStringLiteral("metamer-gui"));
  QApplication::setOrganizationName(QStringLiteral("metamer"));
  QApplication::setApplicationVersion(QStringLiteral(METAMER_VERSION));
  QCommandLineParser parser;
  parser.setApplicationDescription(QStringLiteral("A window on a render service."));
  parser.addHelpOption();
  parser.addVersionOption();
  const QCommandLineOption server(
      QStringLiteral("server"),
      QStringLiteral("unix:PATH, HOST:PORT or tls:HOST:PORT; a private one else."),
      QStringLiteral("SERVER"), qEnvironmentVariable("METAMER_SERVER"));
  parser.addOption(server);
  const QCommandLineOption tour(
      QStringLiteral("tour"),
      QStringLiteral("Writes a picture of each page into FOLDER, and ends."),
      QStringLiteral("FOLDER"));
  const QCommandLineOption dark(QStringLiteral("dark"),
                                QStringLiteral("Dark colours, whatever the desktop has."));
  const QCommandLineOption measure(QStringLiteral("measure"),
                                   QStringLiteral("Prints what so many frames cost, and ends."),
                                   QStringLiteral("FRAMES"));
  const QCommandLineOption documents(
      QStringLiteral("documents"),
      QStringLiteral("With --measure: documents that are opened and closed."),
      QStringLiteral("NUMBER"), QStringLiteral("200"));
  parser.addOption(tour);
  parser.addOption(measure);
  parser.addOption(documents);
  parser.addOption(dark);
  parser.addPositionalArgument(QStringLiteral("scene"), QStringLiteral("Scenes to open."),
                               QStringLiteral("[SCENE…]"));
  parser.process(application);

  // Pages and figures are those of a first start, and leave nothing behind.
  const bool alike = parser.isSet(tour) || parser.isSet(measure);
  std::optional<QTemporaryDir> settings;
  if (alike)
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.emplace().path());
  if (parser.isSet(dark)) metamer::gui::set_dark(application);
  metamer::gui::Link link;
  link.open(parser.value(server));
  metamer::gui::MainWindow window(link);
  window.restore_layout();
  open_scenes(window, parser.positionalArguments());
  window.show();
  if (!alike) metamer::gui::offer_lost_texts(window, metamer::gui::unsaved_folder());
  if (parser.isSet(tour)) (new metamer::gui::Tour(window, parser.value(tour)))->start();
  if (parser.isSet(measure))
    new metamer::gui::Measure(
        window, since,
        {.frames = parser.value(measure).toInt(), .documents = parser.value(documents).toInt()});
  return QApplication::exec();
}
