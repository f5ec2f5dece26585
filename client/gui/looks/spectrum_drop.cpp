#include "client/gui/looks/spectrum_drop.h"

#include <QDropEvent>
#include <QFileInfo>
#include <QTimer>
#include <QUrl>
#include <memory>
#include <utility>

#include "client/gui/app/on_pool.h"
#include "client/gui/looks/look_command.h"
#include "client/gui/looks/swap_dialog.h"
#include "client/tools/scene/light_words.h"
#include "client/tools/scene/look_change.h"

namespace metamer::gui {
namespace {

constexpr int patience = 2000;  // ms, for what is under a place

struct Dropped {
  SpectrumRole role;
  v1::Spectrum spectrum;
};

}  // namespace

SpectrumDrop::SpectrumDrop(MainWindow& window) : QObject(&window), window_(window) {
  connect(&window, &MainWindow::document_chosen, this, &SpectrumDrop::watch);
}

void SpectrumDrop::watch() {
  if (window_.live() == nullptr) return;
  Canvas& canvas = window_.live()->canvas();
  canvas.setAcceptDrops(true);
  canvas.installEventFilter(this);  // once, however often it is said
}

QString SpectrumDrop::word_of(const QMimeData& data) {
  if (!data.hasUrls()) {
    const QString word = data.text().trimmed();
    return word.size() < 4096 && !word.contains(QLatin1Char('\n')) ? word : QString();
  }
  const QString file = data.urls().front().toLocalFile();
  const QString ending = QFileInfo(file).suffix().toLower();
  const bool other = ending == QLatin1String("png") || ending == QLatin1String("exr") ||
                     ending == QLatin1String("txtpb");
  return data.urls().size() == 1 && !other ? file : QString();
}

bool SpectrumDrop::eventFilter(QObject*, QEvent* event) {
  if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop) return false;
  auto& dropped = *static_cast<QDropEvent*>(event);
  const QString word = word_of(*dropped.mimeData());
  if (word.isEmpty() || window_.live() == nullptr) return false;
  dropped.acceptProposedAction();
  if (event->type() == QEvent::Drop)
    drop(word, window_.live()->canvas().pixel_at(dropped.position()));
  return true;
}

/// Whether it is a light or a paint is known once it is read.
void SpectrumDrop::drop(const QString& word, const std::optional<QPoint>& pixel) {
  if (window_.document() == nullptr || !window_.document()->sound()) return;
  const auto read = [word = word.toStdString(),
                     files = window_.document()->sound()]() -> Result<Dropped> {
    return client::role_of_word(word, files->folder()).and_then([&](SpectrumRole role) {
      return client::embedded_spectrum(word, role, files->folder())
          .map([&](v1::Spectrum&& spectrum) {
            return Dropped{role, std::move(spectrum)};
          });
    });
  };
  on_pool(this, read, [this, word, pixel](const Result<Dropped>& found) {
    if (!found) return window_.say(QString::fromStdString(found.error().message));
    if (window_.document() == nullptr || window_.live() == nullptr) return;
    const bool light = found->role == SpectrumRole::emission;
    light || !pixel ? ask(word, light) : paint(word, found->spectrum, *pixel);
  });
}

void SpectrumDrop::paint(const QString& word, const v1::Spectrum& paint, const QPoint& pixel) {
  LivePage* live = window_.live();
  const auto place = live->probe(pixel, 1);
  if (!place) return ask(word, false);
  // One answer, or none in time: then the dialog asks.
  auto* once = new QObject(live);
  connect(live, &LivePage::probed, once,
          [this, live, once, word, paint, place, document = &live->document()](
              const client::ViewPlace& at, const std::shared_ptr<const v1::Probed>& probed) {
            if (at.x != place->x || at.y != place->y) return;
            live->disconnect(once);
            once->deleteLater();
            if (probed->material().empty())
              return window_.say(tr("there is nothing to be painted"));
            v1::LookMaterial material;
            material.set_name(probed->material());
            *material.mutable_diffuse() = paint;
            client::Look look = document->look();
            client::set_material(material, look);
            const QString name = QString::fromStdString(probed->material());
            document->undo().push(
                new LookCommand(*document, std::move(look), tr("%1: %2").arg(name, word)));
            window_.say(tr("%1 is painted with %2").arg(name, word));
          });
  QTimer::singleShot(patience, once, [this, once, word] {
    once->deleteLater();
    ask(word, false);
  });
}

void SpectrumDrop::ask(const QString& word, bool light) {
  if (window_.document() == nullptr) return;
  auto* dialog =
      new SwapDialog(*window_.document(), light ? Swapped::light : Swapped::paint, &window_);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->set_word(word);
  dialog->open();
}

}  // namespace metamer::gui
