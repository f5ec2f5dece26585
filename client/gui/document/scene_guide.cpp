#include "client/gui/document/scene_guide.h"

#include <QFileInfo>
#include <QPointer>
#include <QtConcurrentRun>

#include "client/gui/document/schema_texts.h"
#include "client/tools/scene/completions.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::gui {
namespace {

std::string_view view_of(const QByteArray& bytes) {
  return {bytes.data(), static_cast<std::size_t>(bytes.size())};
}

EditorHelp help_at(const QByteArray& text, int byte) {
  const client::SchemaHelp* schema = schema_help();
  if (schema == nullptr) return {};
  const client::SchemaPath path =
      client::schema_path(view_of(text), static_cast<std::size_t>(byte), *v1::Scene::descriptor());
  const client::FieldHelp found = schema->of(path, view_of(text));
  if (found.signature.empty()) return {};
  EditorHelp help;
  help.line = QString::fromStdString(found.signature);
  help.tip = help_tip(found);
  if (!found.paragraphs.empty())
    help.line += QStringLiteral(" — ") + QString::fromStdString(found.paragraphs.front());
  return help;
}

EditorWords words_at(const QByteArray& text, int byte, const QString& folder) {
  const client::Completions found =
      client::completions(view_of(text), static_cast<std::size_t>(byte), folder.toStdString());
  EditorWords words{static_cast<int>(found.begin), static_cast<int>(found.end), {}};
  for (const std::string& word : found.words) words.words << QString::fromStdString(word);
  return words;
}

}  // namespace

EditorProviders scene_guide(TextFile* file) {
  const QPointer<TextFile> scene(file);
  EditorProviders providers;
  providers.words = [scene](const QByteArray& text, int byte, auto answer) {
    if (!scene) return;
    const QString folder = QFileInfo(scene->path()).absolutePath();
    QtConcurrent::run(words_at, text, byte, folder).then(scene.data(), std::move(answer));
  };
  providers.help = [scene](const QByteArray& text, int byte, auto answer) {
    if (!scene) return;
    QtConcurrent::run(help_at, text, byte).then(scene.data(), std::move(answer));
  };
  return providers;
}

QString new_scene_text() { return QString::fromUtf8(resource(QStringLiteral("new_scene.txtpb"))); }

}  // namespace metamer::gui
