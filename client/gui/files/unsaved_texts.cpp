#include "client/gui/files/unsaved_texts.h"

#include <QDir>
#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSaveFile>
#include <QUuid>
#include <utility>

#include "client/gui/document/document.h"

namespace metamer::gui {
namespace {

QString lock_in(const QDir& folder) { return folder.filePath(QStringLiteral("lock")); }

QStringList texts_in(const QDir& folder) {
  return folder.entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Time);
}

QString new_name() { return QUuid::createUuid().toString(QUuid::WithoutBraces); }

void write_unsaved(const LostText& text) {
  QSaveFile to(text.kept);
  if (!to.open(QIODevice::WriteOnly)) return;
  to.write(QJsonDocument(QJsonObject{{QStringLiteral("path"), text.path},
                                     {QStringLiteral("scene"), text.scene},
                                     {QStringLiteral("text"), text.text}})
               .toJson(QJsonDocument::Compact));
  to.commit();
}

LostText read_unsaved(const QString& file) {
  QFile from(file);
  if (!from.open(QIODevice::ReadOnly)) return {};
  const QJsonObject object = QJsonDocument::fromJson(from.readAll()).object();
  return {.path = object[QStringLiteral("path")].toString(),
          .scene = object[QStringLiteral("scene")].toBool(),
          .text = object[QStringLiteral("text")].toString(),
          .kept = file};
}

}  // namespace

UnsavedTexts::UnsavedTexts(QString root, QObject* parent)
    : QObject(parent), root_(std::move(root)) {
  writer_.setMaxThreadCount(1);
  timer_.setInterval(period);
  connect(&timer_, &QTimer::timeout, this, &UnsavedTexts::keep);
  timer_.start();
}

UnsavedTexts::~UnsavedTexts() {
  writer_.waitForDone();
  if (!lock_) return;
  lock_->unlock();
  QDir(folder_).removeRecursively();
}

/// The folder is another one for each run, so nobody else has its lock.
bool UnsavedTexts::open_folder() {
  if (lock_) return true;
  folder_ = QDir(root_).filePath(new_name());
  if (!QDir().mkpath(folder_)) return false;
  lock_ = std::make_unique<QLockFile>(lock_in(folder_));
  lock_->setStaleLockTime(0);
  return lock_->tryLock(0);
}

void UnsavedTexts::add(TextFile* file) {
  files_.insert(file, {new_name() + QStringLiteral(".json"), {}});
  connect(file, &TextFile::saved, this, [this, file] { drop(file); });
  connect(file, &TextFile::loaded, this, [this, file] { drop(file); });
  connect(file, &QObject::destroyed, this, [this, file] {
    drop(file);
    files_.remove(file);
  });
}

void UnsavedTexts::drop(TextFile* file) {
  Kept& kept = files_[file];
  if (std::exchange(kept.text, {}).isEmpty()) return;
  writer_.start([name = QDir(folder_).filePath(kept.name)] { QFile::remove(name); });
}

void UnsavedTexts::keep() {
  for (auto at = files_.begin(); at != files_.end(); ++at) {
    const TextFile& file = *at.key();
    if (!file.modified()) {
      drop(at.key());
      continue;
    }
    if (file.text() == at->text || !open_folder()) continue;
    at->text = file.text();
    const LostText text{.path = file.path(),
                        .scene = qobject_cast<const Document*>(&file) != nullptr,
                        .text = file.text(),
                        .kept = QDir(folder_).filePath(at->name)};
    writer_.start([text] { write_unsaved(text); });
  }
}

std::vector<LostText> UnsavedTexts::lost(const QString& root) {
  std::vector<LostText> texts;
  for (const QString& run : QDir(root).entryList(QDir::Dirs | QDir::NoDotAndDotDot)) {
    const QDir folder(QDir(root).filePath(run));
    // A lock whose program is no more can be had.
    QLockFile lock(lock_in(folder));
    lock.setStaleLockTime(0);
    if (!lock.tryLock(0)) continue;
    for (const QString& name : texts_in(folder))
      if (LostText text = read_unsaved(folder.filePath(name)); !text.text.isEmpty())
        texts.push_back(std::move(text));
    lock.unlock();
    if (texts_in(folder).isEmpty()) QDir(folder).removeRecursively();
  }
  return texts;
}

void UnsavedTexts::forget(const std::vector<LostText>& texts) {
  for (const LostText& text : texts) {
    QFile::remove(text.kept);
    QDir folder = QFileInfo(text.kept).dir();
    if (texts_in(folder).isEmpty()) folder.removeRecursively();
  }
}

}  // namespace metamer::gui
