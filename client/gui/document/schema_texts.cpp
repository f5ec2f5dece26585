#include "client/gui/document/schema_texts.h"

#include <QFile>
#include <optional>
#include <utility>

/// The macro wants to stand outside of namespaces. A static library's resources are there only
/// after it.
static void open_schema_resource() { Q_INIT_RESOURCE(schema); }

namespace metamer::gui {

QByteArray resource(const QString& name) {
  open_schema_resource();
  QFile file(QStringLiteral(":/") + name);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

const client::SchemaHelp* schema_help() {
  static const std::optional<client::SchemaHelp> help = []() -> std::optional<client::SchemaHelp> {
    Result<client::SchemaHelp> read =
        client::SchemaHelp::read(resource(QStringLiteral("schema.pb")).toStdString());
    if (!read) return std::nullopt;
    return std::move(*read);
  }();
  return help ? &*help : nullptr;
}

QString help_tip(const client::FieldHelp& help) {
  const auto escaped = [](const std::string& text) {
    return QString::fromStdString(text).toHtmlEscaped();
  };
  QString tip = QStringLiteral("<p><b>%1</b></p>").arg(escaped(help.signature));
  for (const std::string& paragraph : help.paragraphs)
    tip += QStringLiteral("<p>%1</p>").arg(escaped(paragraph));
  return tip;
}

}  // namespace metamer::gui
