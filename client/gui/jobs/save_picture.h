#pragma once

#include <QList>
#include <QStringList>
#include <functional>

#include "client/gui/picture/picture.h"
#include "common/problem.h"

class QWidget;

namespace metamer::gui {

/// What a picture can be written as.
enum class PictureFormat { png, png_16, exr, exr_xyz, exr_spectral };

/// "EXR, X Y Z (*.exr)": of a dialog's filter.
QString format_text(PictureFormat format);
/// Those that a picture has all for: a spectrum in each pixel needs its factors.
QList<PictureFormat> formats_of(const Picture& picture);

/// Writes it as `metamer render -o` does. Returns what is to be said of the file; takes its time:
/// not for the window's thread. Error: it has no plan, or can't be written.
Result<QStringList> save_picture(const Picture& picture, const QString& file, PictureFormat format);

/// Asks where to and as what, writes on the pool, and gives what is to be said of it to `say`.
void ask_to_save(QWidget& window, const Picture& picture,
                 const std::function<void(const QString& text)>& say);

}  // namespace metamer::gui
