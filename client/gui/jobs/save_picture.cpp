#include "client/gui/jobs/save_picture.h"

#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>

#include "client/gui/app/on_pool.h"
#include "client/tools/pictures/save_pictures.h"
#include "client/tools/text/saved_text.h"

namespace metamer::gui {
namespace {

QString save_words(const char* text) { return QCoreApplication::translate("Save", text); }

client::ExrContent content_of(PictureFormat format) {
  switch (format) {
    case PictureFormat::exr_xyz:
      return {.xyz = true};
    case PictureFormat::exr_spectral:
      return {.xyz = false, .spectral = *Wavelengths::uniform(380, 780, 5)};
    case PictureFormat::png:
    case PictureFormat::png_16:
    case PictureFormat::exr:
      break;
  }
  return {};
}

bool is_png(PictureFormat format) {
  return format == PictureFormat::png || format == PictureFormat::png_16;
}

/// With the ending that the format has: what was typed without one gets it.
QString with_ending(const QString& file, PictureFormat format) {
  const QString ending = is_png(format) ? QStringLiteral(".png") : QStringLiteral(".exr");
  return file.endsWith(ending, Qt::CaseInsensitive) ? file : file + ending;
}

}  // namespace

QString format_text(PictureFormat format) {
  switch (format) {
    case PictureFormat::png:
      return save_words("PNG (*.png)");
    case PictureFormat::png_16:
      return save_words("PNG of 16 bits (*.png)");
    case PictureFormat::exr:
      return save_words("EXR, linear RGB (*.exr)");
    case PictureFormat::exr_xyz:
      return save_words("EXR, X Y Z (*.exr)");
    case PictureFormat::exr_spectral:
      return save_words("EXR, a spectrum in each pixel (*.exr)");
  }
  return {};
}

QList<PictureFormat> formats_of(const Picture& picture) {
  QList<PictureFormat> formats{PictureFormat::png, PictureFormat::png_16, PictureFormat::exr,
                               PictureFormat::exr_xyz};
  if (picture.factors) formats << PictureFormat::exr_spectral;
  return formats;
}

Result<QStringList> save_picture(const Picture& picture, const QString& file,
                                 PictureFormat format) {
  if (!picture.plan) return problem("nothing is known of how it was rendered");
  if (format == PictureFormat::exr_spectral && !picture.factors)
    return problem("its factors were not kept: there are no spectra");
  Result<client::PlannedDeveloping> planned = client::planned_developing(*picture.plan);
  if (!planned) return tl::unexpected(planned.error());
  planned->developing.bits = format == PictureFormat::png_16 ? 16 : 8;
  const client::Pictures pictures{.xyz = *picture.xyz,
                                  .plan = *picture.plan,
                                  .factors = picture.factors.get(),
                                  .scene = picture.factors ? &picture.factors->scene : nullptr,
                                  .metadata = {{"metamer:scene", picture.title.toStdString()}}};
  const Result<client::SavedPicture> saved =
      client::save_picture(pictures, file.toStdString(), content_of(format), *planned);
  if (!saved) return tl::unexpected(saved.error());
  QStringList notes;
  if (!planned->unadapted.empty())
    notes << save_words("not adapted: %1").arg(QString::fromStdString(planned->unadapted));
  if ((is_png(format) || format == PictureFormat::exr) && !planned->shown_white.empty())
    notes << QString::fromStdString(planned->shown_white);
  for (const std::string& note : client::saved_notes(*saved, *picture.plan, *planned))
    notes << QString::fromStdString(note);
  return notes;
}

void ask_to_save(QWidget& window, const Picture& picture,
                 const std::function<void(const QString& text)>& say) {
  const QList<PictureFormat> formats = formats_of(picture);
  QStringList filters;
  for (const PictureFormat format : formats) filters << format_text(format);
  const QString proposed = QFileInfo(picture.title).completeBaseName() + QStringLiteral(".png");
  QString chosen = filters.front();
  QString file = QFileDialog::getSaveFileName(&window, save_words("Save the picture"), proposed,
                                              filters.join(QStringLiteral(";;")), &chosen);
  if (file.isEmpty()) return;
  const PictureFormat format = formats[std::max<qsizetype>(0, filters.indexOf(chosen))];
  file = with_ending(file, format);
  say(save_words("writing %1").arg(file));
  on_pool(
      &window, [picture, file, format] { return save_picture(picture, file, format); },
      [&window, file, say](const Result<QStringList>& saved) {
        if (!saved)
          QMessageBox::warning(&window, save_words("Save the picture"),
                               QString::fromStdString(metamer::format(saved.error())));
        else
          say((QStringList{save_words("wrote %1").arg(file)} + *saved).join(QStringLiteral("; ")));
      });
}

}  // namespace metamer::gui
