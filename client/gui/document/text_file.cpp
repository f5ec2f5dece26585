#include "client/gui/document/text_file.h"

#include <QFile>
#include <QFileInfo>
#include <QSaveFile>
#include <utility>

#include "common/scene/findings.h"
#include "common/scene/scene_file.h"

namespace metamer::gui {

Result<QString> read_text(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return problem(file.errorString().toStdString());
  if (file.size() > static_cast<qint64>(max_scene_text)) return problem("it is too large a text");
  const QByteArray bytes = file.readAll();
  if (!is_utf8({bytes.data(), static_cast<std::size_t>(bytes.size())}))
    return problem("it is not a text in UTF-8");
  return QString::fromUtf8(bytes);
}

Result<void> TextFile::load(const QString& path) {
  Result<QString> text = read_text(path);
  if (!text) return tl::unexpected(text.error());
  text_ = *std::move(text);
  path_ = path;
  set_on_disk(text_);
  Q_EMIT loaded();
  return {};
}

void TextFile::start_with(const QString& text) {
  text_ = text;
  set_on_disk(text_);
  Q_EMIT loaded();
}

Result<void> TextFile::save(const QString& path) {
  QSaveFile file(path);
  if (!file.open(QIODevice::WriteOnly)) return problem(file.errorString().toStdString());
  file.write(text_.toUtf8());
  if (!file.commit()) return problem(file.errorString().toStdString());
  path_ = path;
  set_on_disk(text_);
  Q_EMIT saved();
  return {};
}

void TextFile::set_on_disk(std::optional<QString> text) {
  on_disk_ = std::move(text);
  modified_ = on_disk_ != text_;
  Q_EMIT title_changed();
}

QString TextFile::title() const {
  return path_.isEmpty() ? tr("untitled") : QFileInfo(path_).fileName();
}

void TextFile::set_text(const QString& text) {
  if (text == text_) return;
  text_ = text;
  const bool differs = on_disk_ != text_;
  if (std::exchange(modified_, differs) != differs) Q_EMIT title_changed();
  Q_EMIT typed();
}

}  // namespace metamer::gui
